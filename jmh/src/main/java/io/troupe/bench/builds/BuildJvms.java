package io.troupe.bench.builds;

import io.troupe.bench.BuildTable;
import io.troupe.bench.BuildTable.Turn;
import io.troupe.bench.builds.BuildVerdict.Round;
import io.troupe.tools.MeasuringJvm;
import java.io.File;
import java.io.IOException;
import java.net.URISyntaxException;
import java.nio.file.FileSystems;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.EnumMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Objects;
import java.util.Random;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/**
 * One start of a part: a JVM with the build before and two with this build, which take turns.
 *
 * <p><b>Role.</b> The benchmarks and the measuring classes of all three are those of this build.
 */
final class BuildJvms implements AutoCloseable {
    /** Longer than any limit in a JVM that measures, so that its error is reported. */
    private static final Duration LIMIT = Duration.ofMinutes(5);

    /** Which of the three. */
    enum Name {
        BEFORE("the build before"),
        NOW("this build"),
        AGAIN("this build, once more");

        private final String text;

        Name(String text) {
            this.text = text;
        }

        @Override
        public String toString() {
            return text;
        }
    }

    /**
     * The class paths of both builds. The first part of each is a folder with this build's measuring classes, which
     * would otherwise come with the older build's common classes.
     */
    record ClassPaths(String before, String now) {
        /** @param now the class path of this build; its classes are used where {@code before} has none */
        static ClassPaths of(BeforeBuild before, String now, Path folder) throws IOException {
            String measuring = copyOf(MeasuringJvm.class, folder) + File.pathSeparator + placeOf(BuildTable.class);
            return new ClassPaths(before.classPath(measuring, now), measuring + File.pathSeparator + now);
        }

        private static Path placeOf(Class<?> type) throws IOException {
            var source = Objects.requireNonNull(type.getProtectionDomain().getCodeSource(), type.getName());
            try {
                return Path.of(source.getLocation().toURI());
            } catch (URISyntaxException wrong) {
                throw new IOException(type + " is at " + source.getLocation() + ", expected a file", wrong);
            }
        }

        /** Copies the classes of a class's package. */
        private static Path copyOf(Class<?> type, Path folder) throws IOException {
            String name = type.getPackageName().replace('.', '/');
            Path place = placeOf(type);
            if (Files.isDirectory(place)) {
                copy(place.resolve(name), folder.resolve(name));
            } else {
                try (var jar = FileSystems.newFileSystem(place)) {
                    copy(jar.getPath(name), folder.resolve(name));
                }
            }
            return folder;
        }

        private static void copy(Path from, Path to) throws IOException {
            Files.createDirectories(to);
            try (Stream<Path> files = Files.list(from)) {
                for (Path file : files.toList()) {
                    Files.write(to.resolve(file.getFileName().toString()), Files.readAllBytes(file));
                }
            }
        }
    }

    /** A row that one of the builds cannot run. */
    static final class RowFailure extends Exception {
        private static final long serialVersionUID = 1;

        private final Name build;

        RowFailure(Name build, String message, @Nullable Throwable cause) {
            super(build + ": " + message, cause);
            this.build = build;
        }

        /** True if it is not for the older build that the row fails. */
        boolean isOfThisBuild() {
            return build != Name.BEFORE;
        }
    }

    private final Map<Name, MeasuringJvm> jvms = new EnumMap<>(Name.class);
    private final Random random;

    BuildJvms(BuildPart part, BuildPart.Setting setting, ClassPaths classPaths, Random random) throws IOException {
        this.random = random;
        for (Name name : Name.values()) {
            List<String> arguments = new ArrayList<>(List.of(part.name(), name.name()));
            arguments.addAll(setting.arguments());
            jvms.put(
                    name,
                    MeasuringJvm.running(Child.class, arguments.toArray(String[]::new))
                            .withOptions(part.jvmOptions())
                            .withLimit(LIMIT)
                            .withClassPath(name == Name.BEFORE ? classPaths.before : classPaths.now)
                            .start());
        }
    }

    /** One turn of each, in random order. */
    Round<Turn> round(BuildTable.Row row, int operations) throws RowFailure {
        var order = new ArrayList<>(List.of(Name.values()));
        Collections.shuffle(order, random);
        Map<Name, Turn> turns = new EnumMap<>(Name.class);
        for (Name name : order) {
            turns.put(name, Turn.parse(ask(name, "turn " + operations + " " + row.name())));
        }
        return new Round<>(of(turns, Name.BEFORE), of(turns, Name.NOW), of(turns, Name.AGAIN));
    }

    private static Turn of(Map<Name, Turn> turns, Name name) {
        return Objects.requireNonNull(turns.get(name));
    }

    /** The bytes that one of the things of a row keeps. */
    double keptBytes(BuildTable.Row row, Name build) throws RowFailure {
        return Double.parseDouble(ask(build, "kept " + row.name()));
    }

    private String ask(Name name, String request) throws RowFailure {
        try {
            return Objects.requireNonNull(jvms.get(name)).ask(request).getFirst();
        } catch (IOException failed) {
            throw new RowFailure(name, String.valueOf(failed.getMessage()), failed);
        }
    }

    @Override
    public void close() {
        jvms.values().forEach(MeasuringJvm::close);
    }

    /**
     * The main class of a build's JVM. It answers {@code turn <operations> <row>} by a {@link Turn}, and {@code kept
     * <row>} by a number of bytes.
     */
    static final class Child {
        private final BuildPart part;
        private final BuildPart.Setting setting;
        private final String jvm;
        private @Nullable BuildTable table;

        private Child(BuildPart part, String jvm, BuildPart.Setting setting) {
            this.part = part;
            this.jvm = jvm;
            this.setting = setting;
        }

        public static void main(String[] arguments) throws Exception {
            List<String> words = Arrays.asList(arguments);
            MeasuringJvm.serve(() -> {
                var child = new Child(
                        BuildPart.valueOf(words.get(0)),
                        words.get(1).toLowerCase(Locale.ROOT),
                        BuildPart.Setting.of(words.subList(2, words.size())));
                return request -> List.of(child.answer(request));
            });
        }

        private String answer(String request) throws Exception {
            try {
                if (table == null) {
                    table = part.table(setting, jvm);
                }
                String[] words = request.split(" ", 3);
                return switch (words[0]) {
                    case "turn" ->
                        table.turn(words[2], Integer.parseInt(words[1])).line();
                    case "kept" -> Double.toString(table.keptBytes(request.substring("kept ".length())));
                    default ->
                        throw new IllegalArgumentException("a request is " + words[0] + ", expected turn or kept");
                };
            } catch (LinkageError lacking) {
                throw new LackingException(lacking);
            }
        }
    }

    /** The build lacks a class or a method that the benchmark uses. */
    private static final class LackingException extends Exception {
        private static final long serialVersionUID = 1;

        LackingException(LinkageError error) {
            super(error);
        }

        @Override
        public String toString() {
            return "it lacks what the benchmark needs, " + getCause();
        }
    }
}
