package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.internal.loop.EntryQueue;
import java.io.IOException;
import java.lang.reflect.Field;
import java.lang.reflect.Method;
import java.lang.reflect.Modifier;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/**
 * Fields that one thread writes for every message share no cache line with fields that other threads use. The JVM
 * decides where fields are: it may move them into gaps that the padding leaves.
 */
final class CacheLinesTest {
    private static final int LINE_BYTES = 64;
    private static final String[] PADDED = {
        "io.troupe.actor.internal.loop.QueueHead.head",
        "io.troupe.actor.internal.loop.QueueTail.tail",
        "io.troupe.actor.IdlePhase.phase",
        "io.troupe.actor.EntryCounterValue.served"
    };

    /** Prints the fields that are too near to a padded field, a line each, then {@code checked} and a number. */
    public static void main(String[] arguments) throws ReflectiveOperationException {
        List<String> found = new ArrayList<>();
        int checked = 0;
        for (Class<?> type : List.of(EntryQueue.class, IdleStrategy.class, EntryCounter.class)) {
            var fields = fields(type);
            for (Field padded : fields) {
                if (List.of(PADDED).contains(padded.getDeclaringClass().getName() + "." + padded.getName())) {
                    checked++;
                    found.addAll(tooNear(padded, fields));
                }
            }
        }
        found.forEach(System.out::println);
        System.out.println("checked " + checked);
    }

    private static List<Field> fields(Class<?> type) {
        List<Field> fields = new ArrayList<>();
        for (Class<?> each = type; each != Object.class; each = each.getSuperclass()) {
            for (Field field : each.getDeclaredFields()) {
                if (!Modifier.isStatic(field.getModifiers()) && field.getType() != byte.class) { // bytes are padding
                    fields.add(field);
                }
            }
        }
        return fields;
    }

    private static List<String> tooNear(Field padded, List<Field> fields) throws ReflectiveOperationException {
        List<String> near = new ArrayList<>();
        long place = offset(padded);
        if (place < LINE_BYTES) {
            near.add(padded + " at " + place + " is near the object before");
        }
        for (Field other : fields) {
            boolean isConstant = Modifier.isFinal(other.getModifiers());
            if (!other.equals(padded) && !isConstant && Math.abs(offset(other) - place) < LINE_BYTES) {
                near.add(padded + " at " + place + " is near " + other + " at " + offset(other));
            }
        }
        return near;
    }

    /** The library has no interface for this; the method of sun.misc.Unsafe is called by its name. */
    private static long offset(Field field) throws ReflectiveOperationException {
        Class<?> type = Class.forName("sun.misc.Unsafe");
        Field instance = type.getDeclaredField("theUnsafe");
        instance.setAccessible(true);
        Method offset = type.getMethod("objectFieldOffset", Field.class);
        return (long) offset.invoke(instance.get(null), field);
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "-XX:+UseCompressedOops",
                "-XX:-UseCompressedOops",
                "-XX:+UseCompactObjectHeaders" // JDK 25; ignored before
            })
    void fieldsThatOneThreadWritesAreFarFromTheOthers(String layout) throws Exception {
        List<String> lines = outputWith(layout);

        assertThat(lines).containsExactly("checked " + PADDED.length);
    }

    @Test
    void fieldsThatAreNearAreFound() throws Exception {
        var fields = fields(Near.class);

        assertThat(tooNear(fields.getFirst(), fields)).hasSize(2);
    }

    @SuppressWarnings("unused")
    private static final class Near {
        private int first;
        private int second;
    }

    private static List<String> outputWith(String layout) throws IOException, InterruptedException {
        var options = List.of("-XX:+IgnoreUnrecognizedVMOptions", layout);
        return ChildJvm.run(ProcessBuilder.Redirect.DISCARD, options, CacheLinesTest.class)
                .lines();
    }
}
