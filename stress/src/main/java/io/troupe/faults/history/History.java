package io.troupe.faults.history;

import java.io.FileOutputStream;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.lang.reflect.Constructor;
import java.lang.reflect.RecordComponent;
import java.net.URLDecoder;
import java.net.URLEncoder;
import java.nio.channels.Channels;
import java.nio.channels.FileChannel;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/**
 * The events of all processes of a run, in the order of their times.
 *
 * <p>A process appends a line for each event to a separate file, with one write, so that a process that is killed loses
 * none. The times are those of the machine's monotonic clock, which all processes share.
 */
public record History(List<Entry> entries) {
    private static final Map<String, Class<?>> TYPES = Arrays.stream(Event.class.getPermittedSubclasses())
            .collect(Collectors.toUnmodifiableMap(Class::getSimpleName, type -> type));
    private static final String SUFFIX = ".history";
    private static final int END_BYTES = 8_192;

    /** @param process the name of the host and the number of the life of its process, like {@code a-3} */
    public record Entry(long nanos, String process, Event event) {
        /** The line in the file, with the process. */
        @Override
        public String toString() {
            return process + " " + line(nanos, event);
        }
    }

    public History {
        entries =
                entries.stream().sorted(Comparator.comparingLong(Entry::nanos)).toList();
    }

    /** Appends the events of one process to its file. Any thread. */
    public static final class Writer implements AutoCloseable {
        private final FileOutputStream file;

        /** @param folder that of the run */
        public Writer(Path folder, String process) {
            try {
                file = new FileOutputStream(folder.resolve(process + SUFFIX).toFile(), true);
            } catch (IOException failure) {
                throw new UncheckedIOException(failure);
            }
        }

        /** Writes an event that happens now. */
        public synchronized void add(Event event) {
            try {
                file.write((line(System.nanoTime(), event) + "\n").getBytes(StandardCharsets.UTF_8));
            } catch (IOException failure) {
                throw new UncheckedIOException(failure);
            }
        }

        @Override
        public synchronized void close() {
            try {
                file.close();
            } catch (IOException failure) {
                throw new UncheckedIOException(failure);
            }
        }
    }

    /** Reads the files of a run. */
    public static History read(Path folder) throws IOException {
        var all = new ArrayList<Entry>();
        try (Stream<Path> files = Files.list(folder)) {
            for (Path file : files.filter(each -> each.toString().endsWith(SUFFIX))
                    .sorted()
                    .toList()) {
                String name = String.valueOf(file.getFileName());
                String process = name.substring(0, name.length() - SUFFIX.length());
                String text = Files.readString(file);
                text.substring(0, text.lastIndexOf('\n') + 1) // a process was killed while it wrote the rest
                        .lines()
                        .map(line -> parsed(process, line))
                        .forEach(all::add);
            }
        }
        return new History(all);
    }

    /** The last events of a process that is writing. */
    public static List<Entry> readEnd(Path folder, String process) throws IOException {
        Path file = folder.resolve(process + SUFFIX);
        if (!Files.exists(file)) {
            return List.of();
        }
        try (var channel = FileChannel.open(file)) {
            channel.position(Math.max(0, channel.size() - END_BYTES));
            String text = new String(Channels.newInputStream(channel).readAllBytes(), StandardCharsets.UTF_8);
            int from = text.length() < END_BYTES ? 0 : text.indexOf('\n') + 1;
            int to = text.lastIndexOf('\n') + 1;
            return text.substring(Math.min(from, to), to)
                    .lines()
                    .map(line -> parsed(process, line))
                    .toList();
        }
    }

    private static String line(long nanos, Event event) {
        var line = new StringBuilder()
                .append(nanos)
                .append(' ')
                .append(event.getClass().getSimpleName());
        for (RecordComponent component : event.getClass().getRecordComponents()) {
            try {
                String value = String.valueOf(component.getAccessor().invoke(event));
                line.append(' ').append(component.getName()).append('=');
                line.append(URLEncoder.encode(value, StandardCharsets.UTF_8));
            } catch (ReflectiveOperationException impossible) {
                throw new IllegalStateException(impossible);
            }
        }
        return line.toString();
    }

    private static Entry parsed(String process, String line) {
        String[] words = line.split(" ");
        try {
            Class<?> type = TYPES.get(words[1]);
            Constructor<?> constructor = type.getDeclaredConstructors()[0];
            RecordComponent[] components = type.getRecordComponents();
            var values = new Object[components.length];
            for (int i = 0; i < values.length; i++) {
                String text = words[i + 2].substring(words[i + 2].indexOf('=') + 1);
                values[i] = value(components[i].getType(), URLDecoder.decode(text, StandardCharsets.UTF_8));
            }
            return new Entry(Long.parseLong(words[0]), process, (Event) constructor.newInstance(values));
        } catch (ReflectiveOperationException | RuntimeException malformed) {
            throw new IllegalArgumentException(process + ": \"" + line + "\" is no event", malformed);
        }
    }

    private static Object value(Class<?> type, String text) {
        if (type == long.class) {
            return Long.parseLong(text);
        } else if (type == int.class) {
            return Integer.parseInt(text);
        } else if (type == double.class) {
            return Double.parseDouble(text);
        } else if (type == boolean.class) {
            return Boolean.parseBoolean(text);
        } else if (type.isEnum()) {
            return Arrays.stream(type.getEnumConstants())
                    .filter(each -> each.toString().equals(text))
                    .findAny()
                    .orElseThrow();
        }
        return text;
    }
}
