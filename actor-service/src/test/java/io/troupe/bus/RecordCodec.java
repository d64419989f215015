package io.troupe.bus;

import java.io.ByteArrayInputStream;
import java.io.ByteArrayOutputStream;
import java.io.DataInputStream;
import java.io.DataOutputStream;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.lang.reflect.RecordComponent;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import org.jspecify.annotations.Nullable;

/**
 * Encodes records of values to bytes, component by component, and decodes them: shows that messages contain nothing
 * else.
 */
final class RecordCodec {
    private RecordCodec() {}

    static byte[] encode(Record value) {
        var bytes = new ByteArrayOutputStream();
        try {
            write(value, new DataOutputStream(bytes), 0);
        } catch (IOException | ReflectiveOperationException failure) {
            throw new IllegalArgumentException("cannot encode " + value, failure);
        }
        return bytes.toByteArray();
    }

    static Record decode(byte[] bytes) {
        try {
            var value = read(new DataInputStream(new ByteArrayInputStream(bytes)), 0);
            return (Record) java.util.Objects.requireNonNull(value);
        } catch (IOException failure) {
            throw new UncheckedIOException(failure);
        } catch (ReflectiveOperationException failure) {
            throw new IllegalArgumentException("cannot decode", failure);
        }
    }

    /** @param level the nesting depth: at most that of a value plus one for the message around it */
    private static void write(@Nullable Object value, DataOutputStream out, int level)
            throws IOException, ReflectiveOperationException {
        checkLevel(level);
        switch (value) {
            case null -> out.writeByte('0');
            case Boolean it -> writeTagged('z', out).writeBoolean(it);
            case Byte it -> writeTagged('b', out).writeByte(it);
            case Short it -> writeTagged('s', out).writeShort(it);
            case Character it -> writeTagged('c', out).writeChar(it);
            case Integer it -> writeTagged('i', out).writeInt(it);
            case Long it -> writeTagged('l', out).writeLong(it);
            case Float it -> writeTagged('f', out).writeFloat(it);
            case Double it -> writeTagged('d', out).writeDouble(it);
            case String it -> writeTagged('S', out).writeUTF(it);
            case Duration it -> writeTagged('D', out).writeUTF(it.toString());
            case Instant it -> writeTagged('I', out).writeUTF(it.toString());
            case Enum<?> it -> {
                writeTagged('E', out).writeUTF(it.getDeclaringClass().getName());
                out.writeUTF(it.name());
            }
            case List<?> it -> {
                writeTagged('L', out).writeInt(it.size());
                for (Object each : it) {
                    write(each, out, level + 1);
                }
            }
            case Map<?, ?> it -> {
                writeTagged('M', out).writeInt(it.size());
                for (var each : it.entrySet()) {
                    write(each.getKey(), out, level + 1);
                    write(each.getValue(), out, level + 1);
                }
            }
            case Optional<?> it -> write(it.orElse(null), writeTagged('O', out), level + 1);
            case Record it -> writeRecord(it, writeTagged('R', out), level);
            default -> throw new IllegalArgumentException("a " + value.getClass() + " cannot leave a process");
        }
    }

    private static DataOutputStream writeTagged(char tag, DataOutputStream out) throws IOException {
        out.writeByte(tag);
        return out;
    }

    private static void checkLevel(int level) {
        if (level > Portable.MAX_LEVELS + 1) { // scalars are one level deeper than the last record
            throw new IllegalArgumentException(
                    "a message is nested deeper than " + Portable.MAX_LEVELS + " levels and its value");
        }
    }

    private static void writeRecord(Record value, DataOutputStream out, int level)
            throws IOException, ReflectiveOperationException {
        out.writeUTF(value.getClass().getName());
        for (RecordComponent component : value.getClass().getRecordComponents()) {
            component.getAccessor().setAccessible(true);
            write(component.getAccessor().invoke(value), out, level + 1);
        }
    }

    private static @Nullable Object read(DataInputStream in, int level)
            throws IOException, ReflectiveOperationException {
        checkLevel(level);
        char tag = (char) in.readByte();
        return switch (tag) {
            case '0' -> null;
            case 'z' -> in.readBoolean();
            case 'b' -> in.readByte();
            case 's' -> in.readShort();
            case 'c' -> in.readChar();
            case 'i' -> in.readInt();
            case 'l' -> in.readLong();
            case 'f' -> in.readFloat();
            case 'd' -> in.readDouble();
            case 'S' -> in.readUTF();
            case 'D' -> Duration.parse(in.readUTF());
            case 'I' -> Instant.parse(in.readUTF());
            case 'E' -> readEnum(Class.forName(in.readUTF()), in.readUTF());
            case 'L' -> readList(in, level);
            case 'M' -> {
                var map = new LinkedHashMap<@Nullable Object, @Nullable Object>();
                for (int count = in.readInt(); count > 0; count--) {
                    map.put(read(in, level + 1), read(in, level + 1));
                }
                yield map;
            }
            case 'O' -> Optional.ofNullable(read(in, level + 1));
            case 'R' -> readRecord(Class.forName(in.readUTF()), in, level);
            default -> throw new IOException("no such tag: " + tag);
        };
    }

    private static List<@Nullable Object> readList(DataInputStream in, int level)
            throws IOException, ReflectiveOperationException {
        var list = new ArrayList<@Nullable Object>();
        for (int count = in.readInt(); count > 0; count--) {
            list.add(read(in, level + 1));
        }
        return list;
    }

    private static Object readEnum(Class<?> type, String name) {
        return Arrays.stream(type.getEnumConstants())
                .filter(each -> ((Enum<?>) each).name().equals(name))
                .findFirst()
                .orElseThrow();
    }

    private static Object readRecord(Class<?> type, DataInputStream in, int level)
            throws IOException, ReflectiveOperationException {
        var components = type.getRecordComponents();
        var parts = new ArrayList<@Nullable Object>();
        for (int i = 0; i < components.length; i++) {
            parts.add(read(in, level + 1));
        }
        var constructor = type.getDeclaredConstructor(
                Arrays.stream(components).map(RecordComponent::getType).toArray(Class<?>[]::new));
        constructor.setAccessible(true);
        return constructor.newInstance(parts.toArray());
    }
}
