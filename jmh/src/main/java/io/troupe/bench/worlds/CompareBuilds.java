package io.troupe.bench.worlds;

import com.sun.management.OperatingSystemMXBean;
import io.troupe.bench.BenchmarkCommand;
import io.troupe.bench.BenchmarkCommand.AtLeastOne;
import io.troupe.common.measure.MeasuringJvm;
import io.troupe.common.measure.ProgressLine;
import io.troupe.common.measure.SampleStatistics;
import io.troupe.common.measure.UsedHeap;
import java.io.File;
import java.io.IOException;
import java.lang.management.ManagementFactory;
import java.lang.management.ThreadMXBean;
import java.lang.ref.Reference;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.concurrent.Callable;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Option;

/**
 * Compares two builds of our simulator.
 *
 * <p><b>Role.</b> Each build runs in a separate JVM on the same scene. They take turns of equal simulated time, in
 * random order within a round, while the other waits. Equal builds do equal work; after each turn the readings of all
 * robots must be the same, bit for bit.
 *
 * <p><b>Errors.</b> The comparison ends if readings differ, unless {@code --other-bits} is given.
 */
@Command(
        name = "CompareBuilds",
        description = "Compares an older build of our simulator with this one.",
        showDefaultValues = true)
public final class CompareBuilds implements Callable<Integer> {
    private static final String HEAD = """
            | scene | robots | simulated seconds per second before | now | ratio by the clock | by processor time | kB per robot before | now |
            |---|--:|--:|--:|--:|--:|--:|--:|
            """;

    @Option(
            names = "--before",
            paramLabel = "JAR",
            required = true,
            description = "the older build: jar or classes of playerlike-sim")
    @SuppressWarnings("NullAway.Init") // required
    String before = "";

    @Option(names = "--scenes", paramLabel = "NAME", split = ",", description = "${COMPLETION-CANDIDATES}")
    List<BuildScene> scenes = List.of(BuildScene.values());

    @Option(
            names = "--robots",
            paramLabel = "N",
            split = ",",
            converter = AtLeastOne.class,
            description = "how many robots")
    List<Integer> robots = List.of(2, 100, 1_000);

    @Option(names = "--rounds", paramLabel = "N", converter = AtLeastOne.class, description = "how many turns")
    int rounds = 9;

    @Option(
            names = "--turn",
            paramLabel = "MILLIS",
            converter = AtLeastOne.class,
            description = "of the slower build, about")
    int turnMillis = 500;

    @Option(names = "--threads", paramLabel = "N", converter = AtLeastOne.class, description = "sensing threads")
    int threads = 1;

    @Option(names = "--other-bits", description = "the builds need not give the same readings")
    boolean otherBits;

    public static void main(String[] arguments) {
        System.exit(BenchmarkCommand.of(new CompareBuilds()).execute(arguments));
    }

    @Override
    public Integer call() throws IOException {
        System.out.printf(
                "Java %s, %d processors, %d rounds of about %d ms%n%n%s",
                Runtime.version(), Runtime.getRuntime().availableProcessors(), rounds, turnMillis, HEAD);
        String now = System.getProperty("java.class.path");
        try (var line = ProgressLine.open();
                MeasuringJvm old = start(before + File.pathSeparator + now);
                MeasuringJvm current = start(now)) {
            for (BuildScene scene : scenes) {
                for (int count : robots) {
                    line.show(scene + ", " + count + " robots");
                    String row = row(scene, count, List.of(old, current));
                    line.interrupt(() -> System.out.print(row));
                }
            }
        }
        return 0;
    }

    private MeasuringJvm start(String classPath) throws IOException {
        return MeasuringJvm.running(Child.class, Integer.toString(threads))
                .withOptions("-Xmx2g", "-XX:+UseSerialGC")
                .withClassPath(classPath)
                .start();
    }

    /** One turn of a build. */
    private record Turn(double wallNanos, double processorNanos, String checksum) {
        static Turn of(MeasuringJvm jvm, long intervals) throws IOException {
            String[] words = jvm.ask("advance " + intervals).getFirst().split(" ");
            return new Turn(Double.parseDouble(words[0]), Double.parseDouble(words[1]), words[2]);
        }
    }

    private String row(BuildScene scene, int count, List<MeasuringJvm> builds) throws IOException {
        List<Double> bytes = new ArrayList<>();
        for (MeasuringJvm build : builds) {
            bytes.add(Double.parseDouble(
                    build.ask("build " + scene.name() + " " + count).getFirst()));
        }
        long intervals = warmUp(builds);
        List<Double> before = new ArrayList<>();
        List<Double> now = new ArrayList<>();
        List<Double> byClock = new ArrayList<>();
        List<Double> byProcessor = new ArrayList<>();
        var random = new Random(1);
        for (int round = 0; round < rounds; round++) {
            boolean oldFirst = random.nextBoolean();
            Turn first = Turn.of(builds.get(oldFirst ? 0 : 1), intervals);
            Turn second = Turn.of(builds.get(oldFirst ? 1 : 0), intervals);
            Turn older = oldFirst ? first : second;
            Turn newer = oldFirst ? second : first;
            check(older, newer, scene, count);
            double simulatedNanos = intervals * TiledScene.INTERVAL_MILLIS * 1e6;
            before.add(simulatedNanos / older.wallNanos);
            now.add(simulatedNanos / newer.wallNanos);
            byClock.add(older.wallNanos / newer.wallNanos);
            byProcessor.add(older.processorNanos / newer.processorNanos);
        }
        return WorldsReport.format(
                "| %s | %,d | %s | %s | %s | %s | %.1f | %.1f |%n",
                scene,
                count,
                SampleStatistics.of(before).text(WorldsReport::number),
                SampleStatistics.of(now).text(WorldsReport::number),
                SampleStatistics.of(byClock).text(WorldsReport::number),
                SampleStatistics.of(byProcessor).text(WorldsReport::number),
                bytes.get(0) / count / 1e3,
                bytes.get(1) / count / 1e3);
    }

    /** Runs both builds for the same simulated time, until the slower one has run for six turns; returns a turn. */
    private long warmUp(List<MeasuringJvm> builds) throws IOException {
        long intervals = 1;
        double spentNanos = 0;
        while (true) {
            Turn older = Turn.of(builds.get(0), intervals);
            Turn newer = Turn.of(builds.get(1), intervals);
            double slowerNanos = Math.max(older.wallNanos, newer.wallNanos);
            spentNanos += slowerNanos;
            double wantedNanos = turnMillis * 1e6;
            if (spentNanos > 6 * wantedNanos) {
                return Math.max(1, Math.round(intervals * wantedNanos / slowerNanos));
            }
            if (slowerNanos < wantedNanos) {
                intervals *= 2;
            }
        }
    }

    private void check(Turn older, Turn newer, BuildScene scene, int count) {
        if (!otherBits && !older.checksum.equals(newer.checksum)) {
            throw new IllegalStateException("the readings of " + count + " robots in scene " + scene
                    + " have the checksum " + newer.checksum + ", expected " + older.checksum
                    + " as in the build before");
        }
    }

    /**
     * The main class of a build's JVM. It answers {@code build <scene> <robots>} by the bytes that the world retains,
     * and {@code advance <intervals>} by wall-clock and processor time and the checksum of the readings.
     */
    static final class Child {
        private static final OperatingSystemMXBean SYSTEM =
                ManagementFactory.getPlatformMXBean(OperatingSystemMXBean.class);

        private static final ThreadMXBean THREADS = ManagementFactory.getThreadMXBean();

        private final int threads;
        private @Nullable TroupeWorld world;

        private Child(int threads) {
            this.threads = threads;
        }

        public static void main(String[] arguments) throws Exception {
            var child = new Child(Integer.parseInt(arguments[0]));
            MeasuringJvm.serve(() -> request -> List.of(child.answer(request.split(" "))));
        }

        private String answer(String[] request) {
            return switch (request[0]) {
                case "build" -> Long.toString(build(request[1], Integer.parseInt(request[2])));
                case "advance" -> advance(Long.parseLong(request[1]));
                default -> throw new IllegalArgumentException(request[0] + ", expected build or advance");
            };
        }

        private long build(String scene, int count) {
            world = null;
            var spec = BuildScene.valueOf(scene).spec(count);
            long empty = UsedHeap.bytes();
            var built = new TroupeWorld(spec, true, threads);
            built.advance(5);
            world = built;
            long bytes = UsedHeap.bytes() - empty;
            Reference.reachabilityFence(spec);
            return bytes;
        }

        /** Of this thread, which is exact; of the process, in steps of 10 ms, if there are sensing threads. */
        private long processorNanos() {
            return threads == 1 ? THREADS.getCurrentThreadCpuTime() : SYSTEM.getProcessCpuTime();
        }

        private String advance(long intervals) {
            TroupeWorld running = world;
            if (running == null) {
                throw new IllegalStateException("a turn was asked for before a world was built");
            }
            long processor = processorNanos();
            long wall = System.nanoTime();
            running.advance(Math.toIntExact(intervals));
            wall = System.nanoTime() - wall;
            processor = processorNanos() - processor;
            return wall + " " + processor + " " + running.checksum();
        }
    }
}
