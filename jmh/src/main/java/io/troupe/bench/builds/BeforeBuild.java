package io.troupe.bench.builds;

import java.io.File;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.FileTime;
import java.util.ArrayList;
import java.util.Collection;
import java.util.EnumMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.jar.JarFile;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/**
 * The jars and class folders of an older build.
 *
 * <p><b>Units and shapes.</b> A path is a jar, a folder of classes, the checkout of a build or of one of its modules,
 * or a folder that has {@code troupe-*.jar} in it or in its subfolders, such as a local Maven repository's
 * {@code io/troupe}. Of several paths the first with a class counts, as in a class path.
 *
 * @param entries of the class path
 */
record BeforeBuild(List<Path> entries) {
    /** {@code repository/io/troupe/ARTIFACT/VERSION/FILE}, seen from the repository. */
    private static final int DEPTH = 5;

    private static final Pattern JAR = Pattern.compile("troupe-.*(?<!-sources|-javadoc|-tests)\\.jar");
    private static final List<List<String>> CLASSES =
            List.of(List.of("target/classes"), List.of("build/classes/java/main", "build/resources/main"));

    /** A module that is measured or that these use, with a class by which it is known. */
    enum Module {
        COMMON("common", "io/troupe/common/text/SourceScanner.class"),
        ACTOR_CORE("actor-core", "io/troupe/actor/ActorSpace.class"),
        ACTOR_SERVICE("actor-service", "io/troupe/bus/Bus.class"),
        ACTOR_NATS("actor-nats", "io/troupe/bus/nats/NatsBus.class"),
        PLAYERLIKE_SIM("playerlike-sim", "io/troupe/sim/World.class"),
        SERVICES("services", "io/troupe/services/behaviour/Behaviour.class"),
        VERIFICATION("verification", "io/troupe/petri/PetriNet.class");

        private final String folder;
        private final String marker;

        Module(String folder, String marker) {
            this.folder = folder;
            this.marker = marker;
        }

        String marker() {
            return marker;
        }

        @Override
        public String toString() {
            return folder;
        }
    }

    /**
     * Finds the build at these paths.
     *
     * @throws IllegalArgumentException if there is nothing at a path, or two builds of one module
     */
    static BeforeBuild at(List<Path> paths) throws IOException {
        List<Path> entries = new ArrayList<>();
        for (Path path : paths) {
            List<Path> found = find(path.toAbsolutePath().normalize());
            if (found.isEmpty()) {
                throw new IllegalArgumentException("--before is " + path
                        + ", which has no build of Troupe; expected a jar, a folder of classes, a checkout that was"
                        + " built (MODULE/target/classes or MODULE/build/classes/java/main), or a folder with"
                        + " troupe-*.jar in it or below it");
            }
            entries.addAll(found);
        }
        return new BeforeBuild(entries.stream().distinct().toList());
    }

    private static List<Path> find(Path path) throws IOException {
        if (Files.isRegularFile(path) && path.toString().endsWith(".jar")) {
            return List.of(path);
        }
        if (!Files.isDirectory(path)) {
            return List.of();
        }
        if (hasClasses(path)) {
            return List.of(path);
        }
        List<Path> built = checkout(path);
        return built.isEmpty() ? jars(path) : built;
    }

    private static boolean hasClasses(Path folder) throws IOException {
        Path classes = folder.resolve("io/troupe");
        if (!Files.isDirectory(classes)) {
            return false;
        }
        try (Stream<Path> files = Files.walk(classes)) {
            return files.anyMatch(file -> file.toString().endsWith(".class"));
        }
    }

    /** The class folders of a checkout or of one module. */
    private static List<Path> checkout(Path path) {
        return Stream.concat(Stream.of(path), Stream.of(Module.values()).map(each -> path.resolve(each.folder)))
                .flatMap(module -> newest(module).stream())
                .toList();
    }

    /** The class folders that one of the build tools made: the one that ran last. */
    private static List<Path> newest(Path module) {
        List<Path> newest = List.of();
        FileTime last = FileTime.fromMillis(0);
        for (List<String> names : CLASSES) {
            List<Path> folders = names.stream()
                    .map(module::resolve)
                    .filter(Files::isDirectory)
                    .toList();
            for (Module each : Module.values()) {
                FileTime written = timeOf(module.resolve(names.getFirst()).resolve(each.marker));
                if (written.compareTo(last) > 0) {
                    newest = folders;
                    last = written;
                }
            }
        }
        return newest;
    }

    private static FileTime timeOf(Path file) {
        try {
            return Files.getLastModifiedTime(file);
        } catch (IOException missing) {
            return FileTime.fromMillis(0);
        }
    }

    /** The jars of our modules below a folder; none may be there in two versions. */
    private static List<Path> jars(Path folder) throws IOException {
        List<Path> all;
        try (Stream<Path> files = Files.find(
                folder,
                DEPTH,
                (file, attributes) -> attributes.isRegularFile()
                        && JAR.matcher(file.getFileName().toString()).matches())) {
            all = files.sorted().toList();
        }
        Map<Module, Path> found = new EnumMap<>(Module.class);
        for (Path jar : all) {
            for (Module module : modulesOf(List.of(jar))) {
                Path other = found.putIfAbsent(module, jar);
                if (other != null) {
                    throw new IllegalArgumentException("--before is " + folder + ", which has " + module + " twice: "
                            + other + " and " + jar + "; expected it once: give the jars themselves, or a folder that"
                            + " has one version");
                }
            }
        }
        return List.copyOf(found.values());
    }

    private static List<Module> modulesOf(List<Path> entries) throws IOException {
        List<Module> found = new ArrayList<>();
        for (Module module : Module.values()) {
            if (placeOf(module, entries).isPresent()) {
                found.add(module);
            }
        }
        return found;
    }

    private static Optional<Path> placeOf(Module module, List<Path> entries) throws IOException {
        for (Path entry : entries) {
            if (contains(entry, module.marker)) {
                return Optional.of(entry);
            }
        }
        return Optional.empty();
    }

    private static boolean contains(Path entry, String marker) throws IOException {
        if (Files.isDirectory(entry)) {
            return Files.isRegularFile(entry.resolve(marker));
        }
        try (var jar = new JarFile(entry.toFile())) {
            return jar.getEntry(marker) != null;
        } catch (IOException broken) {
            throw new IOException("--before has " + entry + ", which cannot be read as a jar", broken);
        }
    }

    /**
     * Checks that the build has these modules.
     *
     * @throws IllegalArgumentException naming those that it lacks
     */
    void require(BuildPart part, Collection<Module> modules) throws IOException {
        for (Module module : modules) {
            if (placeOf(module, entries).isEmpty()) {
                throw new IllegalArgumentException("--before has no " + module + ", which the part " + part
                        + " measures: expected troupe-" + module + "-VERSION.jar or classes with " + module.marker
                        + " in " + entries.stream().map(Path::toString).collect(Collectors.joining(", "))
                        + "; or choose other parts by --parts");
            }
        }
    }

    /**
     * The class path of the older build. What it does not have, such as further libraries, is of {@code now}.
     *
     * @param measuring comes first
     */
    String classPath(String measuring, String now) {
        List<String> all = new ArrayList<>(List.of(measuring));
        entries.forEach(each -> all.add(each.toString()));
        all.add(now);
        return String.join(File.pathSeparator, all);
    }
}
