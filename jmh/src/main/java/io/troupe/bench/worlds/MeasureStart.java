package io.troupe.bench.worlds;

import io.troupe.bench.BenchmarkCommand;
import io.troupe.bench.BenchmarkCommand.AtLeastOne;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.tools.SampleStatistics;
import java.io.File;
import java.io.IOException;
import java.io.OutputStream;
import java.lang.management.ManagementFactory;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.concurrent.Callable;
import java.util.function.ToDoubleFunction;
import java.util.jar.JarOutputStream;
import java.util.stream.Stream;
import java.util.zip.ZipEntry;
import picocli.CommandLine.Command;
import picocli.CommandLine.Option;

/**
 * Measures how long a world takes to start in a new JVM: from the first instruction of its main method until the world
 * is at its first tick. That includes reading the file with what it includes, building the world, and loading all
 * classes.
 *
 * <p><b>Role.</b> Starts JVMs one after the other, in turns with the classes in folders (as Maven compiles them), in
 * jars, in jars with a shared archive of the classes ({@code -XX:SharedArchiveFile}), and with a cache of classes that
 * are linked already ({@code -XX:AOTCache}, from JDK 25 on). A start before the others makes archive and cache.
 *
 * <p><b>Units and shapes.</b> Milliseconds; medians and quartiles. The processor time is that of the whole JVM up to
 * the first tick, its start and its compilers included.
 */
@Command(
        name = "MeasureStart",
        description = "Measures how long a world takes to start in a new JVM.",
        showDefaultValues = true)
public final class MeasureStart implements Callable<Integer> {
    /** The first JDK that makes a cache in one run. */
    private static final int AOT_CACHES_SINCE = 25;

    @Option(names = "--world", paramLabel = "FILE", description = "what to start")
    Path world = Path.of("demo/worlds/paper-arena.world");

    @Option(names = "--rounds", paramLabel = "N", converter = AtLeastOne.class, description = "starts of each kind")
    int rounds = 10;

    /** A way to start. */
    private record Kind(String name, List<String> options, List<Start> starts) {}

    /** The times of one start, in milliseconds. */
    private record Start(double toMain, double read, double build, double tick, double processor) {
        double afterMain() {
            return read + build + tick;
        }

        double total() {
            return toMain + afterMain();
        }

        static Start parse(String line) {
            double[] numbers =
                    Stream.of(line.split(" ")).mapToDouble(Double::parseDouble).toArray();
            return new Start(numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]);
        }
    }

    public static void main(String... arguments) {
        System.exit(BenchmarkCommand.of(new MeasureStart()).execute(arguments));
    }

    @Override
    public Integer call() throws IOException, InterruptedException {
        System.out.printf(
                Locale.ROOT,
                "Java %s, %d processors, load %.1f, %s%n%n",
                Runtime.version(),
                Runtime.getRuntime().availableProcessors(),
                ManagementFactory.getOperatingSystemMXBean().getSystemLoadAverage(),
                world.getFileName());
        Path folder = Files.createTempDirectory("start");
        try {
            List<Kind> kinds = kinds(folder);
            for (int round = 0; round < rounds; round++) {
                for (Kind kind : kinds) {
                    kind.starts().add(Start.parse(run(kind.options())));
                }
            }
            System.out.println("| classes | from main to the first tick, ms | reading | building | first tick"
                    + " | from the start of the JVM | processor time of the JVM |");
            System.out.println("|---|--:|--:|--:|--:|--:|--:|");
            kinds.forEach(kind -> System.out.println(row(kind)));
        } finally {
            try (Stream<Path> files = Files.list(folder)) {
                files.map(Path::toFile).forEach(File::delete);
            }
            Files.delete(folder);
        }
        return 0;
    }

    private List<Kind> kinds(Path folder) throws IOException, InterruptedException {
        List<String> given = List.of(System.getProperty("java.class.path").split(File.pathSeparator));
        List<String> packed = new ArrayList<>();
        for (String entry : given) {
            packed.add(Files.isDirectory(Path.of(entry)) ? pack(Path.of(entry), folder, packed.size()) : entry);
        }
        String folders = String.join(File.pathSeparator, given);
        String jars = String.join(File.pathSeparator, packed);
        String archive = folder.resolve("classes.jsa").toString();
        run(List.of("-XX:ArchiveClassesAtExit=" + archive, "-cp", jars));
        List<Kind> kinds = new ArrayList<>();
        kinds.add(new Kind("as they are", List.of("-cp", folders), new ArrayList<>()));
        kinds.add(new Kind("in jars", List.of("-cp", jars), new ArrayList<>()));
        kinds.add(new Kind(
                "in jars, shared archive",
                List.of("-XX:SharedArchiveFile=" + archive, "-cp", jars),
                new ArrayList<>()));
        if (Runtime.version().feature() >= AOT_CACHES_SINCE) {
            String cache = folder.resolve("classes.aot").toString();
            run(List.of("-XX:AOTCacheOutput=" + cache, "-cp", jars));
            kinds.add(new Kind("in jars, AOT cache", List.of("-XX:AOTCache=" + cache, "-cp", jars), new ArrayList<>()));
        }
        return kinds;
    }

    /** Packs a folder of classes into a jar, since an archive can be made of jars only. */
    private static String pack(Path classes, Path folder, int number) throws IOException {
        Path jar = folder.resolve(number + ".jar");
        try (OutputStream out = Files.newOutputStream(jar);
                var zip = new JarOutputStream(out);
                Stream<Path> files = Files.walk(classes)) {
            for (Path file : files.filter(Files::isRegularFile).sorted().toList()) {
                zip.putNextEntry(
                        new ZipEntry(classes.relativize(file).toString().replace(File.separatorChar, '/')));
                Files.copy(file, zip);
                zip.closeEntry();
            }
        }
        return jar.toString();
    }

    /** The last line that a child JVM prints. */
    private String run(List<String> options) throws IOException, InterruptedException {
        List<String> command = new ArrayList<>();
        command.add(Path.of(System.getProperty("java.home"), "bin", "java").toString());
        command.addAll(options);
        command.addAll(List.of(Child.class.getName(), world.toString()));
        Process process = new ProcessBuilder(command).redirectErrorStream(true).start();
        String output = new String(process.getInputStream().readAllBytes(), StandardCharsets.UTF_8).strip();
        int status = process.waitFor();
        if (status != 0) {
            throw new IOException("the JVM has ended with status " + status + ": " + output);
        }
        return output.lines()
                .filter(line -> line.matches("[0-9. ]+"))
                .findFirst()
                .orElseThrow(() ->
                        new IOException("the JVM has printed \"" + output + "\", expected the times of its start"));
    }

    private static String row(Kind kind) {
        return "| " + kind.name()
                + cell(kind, Start::afterMain)
                + cell(kind, Start::read)
                + cell(kind, Start::build)
                + cell(kind, Start::tick)
                + cell(kind, Start::total)
                + cell(kind, Start::processor)
                + " |";
    }

    private static String cell(Kind kind, ToDoubleFunction<Start> time) {
        return " | "
                + SampleStatistics.of(
                                kind.starts().stream().map(time::applyAsDouble).toList())
                        .text(number -> String.format(Locale.ROOT, "%.0f", number));
    }

    /** The main class of a start. It prints the times of {@link Start}, which it reads from the JVM only at the end. */
    static final class Child {
        private Child() {}

        public static void main(String[] arguments) {
            long millis = System.currentTimeMillis();
            long main = System.nanoTime();
            var scenario = ScenarioReader.read(Path.of(arguments[0]));
            long read = System.nanoTime();
            World world = World.create(scenario.world(), WorldSettings.defaults());
            long built = System.nanoTime();
            world.advance();
            long ticked = System.nanoTime();
            double processor = ProcessHandle.current()
                    .info()
                    .totalCpuDuration()
                    .map(used -> used.toNanos() / 1e6)
                    .orElse(0.0);
            long started = ManagementFactory.getRuntimeMXBean().getStartTime();
            System.out.println(millis - started + " " + (read - main) / 1e6 + " " + (built - read) / 1e6 + " "
                    + (ticked - built) / 1e6 + " " + processor);
        }
    }
}
