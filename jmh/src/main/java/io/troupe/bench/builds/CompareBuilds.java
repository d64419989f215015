package io.troupe.bench.builds;

import io.troupe.bench.BenchmarkCommand;
import io.troupe.bench.BenchmarkCommand.AtLeastOne;
import io.troupe.bench.BuildTable;
import io.troupe.bench.BuildTable.Choice;
import io.troupe.bench.BuildTable.Row;
import io.troupe.bench.BuildTable.Turn;
import io.troupe.bench.builds.BuildJvms.ClassPaths;
import io.troupe.bench.builds.BuildJvms.RowFailure;
import io.troupe.bench.builds.BuildVerdict.Round;
import io.troupe.tools.NatsServerProcess;
import io.troupe.tools.ProgressLine;
import java.io.IOException;
import java.io.PrintStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.EnumMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.concurrent.Callable;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Help.Visibility;
import picocli.CommandLine.Option;

/**
 * Compares an older build of Troupe with this one, and reports what became slower.
 *
 * <p><b>Role.</b> For each part several starts of three JVMs, one with the older build and two with this one, take
 * turns with equal work, in random order within a round. The {@link BuildVerdict} compares the difference of the builds
 * with that of this build from itself.
 *
 * <p><b>Errors.</b> A row that the older build cannot run, or whose answers differ between the builds, is reported and
 * left out. The exit status is 1 if a row became slower or does not run in this build, and 2 if an option is wrong.
 */
@Command(
        name = "CompareBuilds",
        description = "Compares an older build of Troupe with this one, and reports what became slower.",
        showDefaultValues = true,
        footer = {"", "The exit status is 1 if something became slower, or does not run in this build, and otherwise 0."
        })
public final class CompareBuilds implements Callable<Integer> {
    private static final int SLOWER = 1;
    private static final int WRONG = 2;
    private static final int MOST_OPERATIONS = 100_000_000;
    private static final double GROWTH = 4;
    private static final double WAITING_COUNTS = 0.25;

    @Option(
            names = "--before",
            paramLabel = "PATH",
            split = ",",
            required = true,
            description = "the older build: a folder with troupe-*.jar, a checkout that was built, a folder of"
                    + " classes, a jar, or several of these")
    List<Path> before = List.of();

    @Option(
            names = "--parts",
            paramLabel = "NAME",
            split = ",",
            converter = BuildPart.Converter.class,
            description = "${COMPLETION-CANDIDATES}")
    List<BuildPart> parts = List.of(BuildPart.values());

    @Option(
            names = "--row",
            paramLabel = "TEXT",
            description = "only rows with this text in their name, also those of more than a second; several times")
    List<String> texts = List.of();

    @Option(names = "--starts", paramLabel = "N", converter = AtLeastOne.class, description = "of each JVM, per part")
    int starts = 8;

    @Option(names = "--rounds", paramLabel = "N", converter = AtLeastOne.class, description = "in each start")
    int rounds = 5;

    @Option(
            names = "--turn",
            paramLabel = "MILLIS",
            converter = AtLeastOne.class,
            description = "of processor time, of the slowest JVM, about")
    int turnMillis = 40;

    @Option(
            names = "--warm-up",
            paramLabel = "MILLIS",
            converter = AtLeastOne.class,
            description = "of processor time, of each row in each start")
    int warmUpMillis = 400;

    @Option(
            names = "--robots",
            paramLabel = "N",
            split = ",",
            converter = AtLeastOne.class,
            description = "in each scene of the simulator; 100 if none are given, and in one scene 2 and 1000 too")
    List<Integer> robots = List.of();

    @Option(names = "--threads", paramLabel = "N", converter = AtLeastOne.class, description = "sensing threads")
    int threads = 1;

    @Option(
            names = "--other-answers",
            description = "the builds need not give the same readings, bit for bit, and the same results of searches")
    boolean otherAnswers;

    @Option(names = "--seed", paramLabel = "N", description = "of the order of the turns")
    long seed = 1;

    private boolean isQuick;

    /** Replaces the options before it, and is replaced by those after it. */
    @Option(
            names = "--quick",
            description = "as --starts 4 --rounds 3 --turn 20 --warm-up 150, with fewer rows",
            showDefaultValue = Visibility.NEVER)
    private void quick(boolean chosen) {
        if (chosen) {
            isQuick = true;
            starts = 4;
            rounds = 3;
            turnMillis = 20;
            warmUpMillis = 150;
        }
    }

    public static void main(String[] arguments) {
        System.exit(BenchmarkCommand.of(new CompareBuilds()).execute(arguments));
    }

    /** What was measured of a row; a start that failed is not among them. */
    static final class RowResult {
        final Row row;
        final List<List<Round<Turn>>> starts = new ArrayList<>();
        final Map<BuildJvms.Name, Double> keptBytes = new EnumMap<>(BuildJvms.Name.class);

        @Nullable
        RowFailure failure;

        @Nullable
        RowFailure keptFailure;

        RowResult(Row row) {
            this.row = row;
        }
    }

    @Override
    public Integer call() throws IOException {
        return call(System.getProperty("java.class.path"), System.out, System.err);
    }

    /** @param now the class path of this build */
    int call(String now, PrintStream out, PrintStream err) throws IOException {
        boolean hasServer = parts.contains(BuildPart.BUS) && NatsServerProcess.isInstalled();
        BeforeBuild build;
        try {
            build = BeforeBuild.at(before);
            for (BuildPart part : parts) {
                build.require(part, part.modules(hasServer));
            }
            checkTexts(hasServer);
        } catch (IllegalArgumentException wrong) {
            err.println(wrong.getMessage());
            return WRONG;
        }
        Path folder = Files.createTempDirectory("troupe-measuring");
        try {
            var classPaths = ClassPaths.of(build, now, folder);
            if (!hasServer) {
                return compare(build, classPaths, null, out);
            }
            try (var server = NatsServerProcess.start()) {
                return compare(build, classPaths, server.address(), out);
            }
        } finally {
            delete(folder);
        }
    }

    private static void delete(Path folder) throws IOException {
        try (Stream<Path> files = Files.walk(folder)) {
            for (Path file : files.sorted(Comparator.reverseOrder()).toList()) {
                Files.delete(file);
            }
        }
    }

    private BuildPart.Setting setting(@Nullable String server) {
        return new BuildPart.Setting(robots, threads, server);
    }

    private List<BuildTable.Row> rows(BuildPart part, BuildPart.Setting setting) {
        return part.table(setting, "").rows().stream()
                .filter(row -> texts.isEmpty()
                        ? row.choice() == Choice.QUICK || !isQuick && row.choice() == Choice.USUAL
                        : texts.stream().anyMatch(row.name()::contains))
                .toList();
    }

    private void checkTexts(boolean hasServer) {
        var setting = setting(hasServer ? "any" : null);
        List<String> names = parts.stream()
                .flatMap(part -> part.table(setting, "").rows().stream().map(Row::name))
                .toList();
        for (String text : texts) {
            if (names.stream().noneMatch(name -> name.contains(text))) {
                throw new IllegalArgumentException(
                        "--row is " + text + ", expected a part of one of these names: " + String.join("; ", names));
            }
        }
    }

    private int compare(BeforeBuild build, ClassPaths classPaths, @Nullable String server, PrintStream out)
            throws IOException {
        var report = new BuildsReport(this);
        out.print(report.head(build));
        var setting = setting(server);
        var random = new Random(seed);
        Map<BuildPart, List<RowResult>> results = new EnumMap<>(BuildPart.class);
        try (var line = ProgressLine.open()) {
            for (BuildPart part : parts.stream().distinct().toList()) {
                List<RowResult> rows =
                        rows(part, setting).stream().map(RowResult::new).toList();
                if (!rows.isEmpty()) {
                    measure(part, rows, () -> new BuildJvms(part, setting, classPaths, random), line);
                    results.put(part, rows);
                    line.interrupt(() -> out.print(report.table(part, rows)));
                }
            }
        }
        out.print(report.summary(results, server == null && parts.contains(BuildPart.BUS)));
        return BuildsReport.isSlower(results) ? SLOWER : 0;
    }

    private interface Starter {
        BuildJvms start() throws IOException;
    }

    private void measure(BuildPart part, List<RowResult> rows, Starter starter, ProgressLine line) throws IOException {
        for (int start = 1; start <= starts; start++) {
            BuildJvms jvms = starter.start();
            try {
                for (RowResult result : rows) {
                    line.show(part + ", start " + start + " of " + starts + ": " + result.row.name());
                    if (result.failure == null && !measure(result, jvms)) {
                        jvms.close();
                        jvms = starter.start(); // one of them may be stuck
                    }
                }
                if (start == 1) {
                    measureKept(rows, jvms, line);
                }
            } finally {
                jvms.close();
            }
        }
    }

    /** Runs a row in one start; false if it failed. */
    private boolean measure(RowResult result, BuildJvms jvms) {
        try {
            int operations = warmUp(result.row, jvms);
            List<Round<Turn>> all = new ArrayList<>();
            for (int round = 0; round < rounds; round++) {
                all.add(round(result.row, jvms, operations));
            }
            result.starts.add(all);
            return true;
        } catch (RowFailure failed) {
            result.failure = failed;
            return false;
        }
    }

    /**
     * Runs growing numbers of operations in all JVMs until each has run for long enough; returns how many fill a turn.
     */
    private int warmUp(Row row, BuildJvms jvms) throws RowFailure {
        int operations = 1;
        double spentNanos = 0; // of the JVM that has run least
        while (true) {
            Round<Turn> round = round(row, jvms, operations);
            List<Turn> turns = List.of(round.before(), round.now(), round.again());
            spentNanos +=
                    turns.stream().mapToDouble(CompareBuilds::length).min().orElseThrow();
            double growth = turnMillis
                    * 1e6
                    / turns.stream().mapToDouble(CompareBuilds::length).max().orElseThrow();
            boolean isOver = spentNanos >= warmUpMillis * 1e6;
            operations =
                    (int) Math.clamp(operations * (isOver ? growth : Math.min(GROWTH, growth)), 1, MOST_OPERATIONS);
            if (isOver) {
                return operations;
            }
        }
    }

    /**
     * The processor time: while other programs have the processor, nothing is compiled. But waiting counts a little.
     */
    private static double length(Turn turn) {
        return Math.max(1, Math.max(turn.processorNanos(), turn.nanos() * WAITING_COUNTS));
    }

    private Round<Turn> round(Row row, BuildJvms jvms, int operations) throws RowFailure {
        Round<Turn> round = jvms.round(row, operations);
        compareAnswers(BuildJvms.Name.AGAIN, round.again().answer(), round.now().answer());
        if (!otherAnswers) {
            compareAnswers(
                    BuildJvms.Name.BEFORE, round.before().answer(), round.now().answer());
        }
        return round;
    }

    private static void compareAnswers(BuildJvms.Name build, String answer, String expected) throws RowFailure {
        if (!answer.equals(expected)) {
            throw new RowFailure(
                    build,
                    "it answers \"" + answer + "\", and this build \"" + expected + "\", expected the same",
                    null);
        }
    }

    private static void measureKept(List<RowResult> rows, BuildJvms jvms, ProgressLine line) {
        for (RowResult result : rows) {
            if (result.failure == null && !result.row.kept().isEmpty()) {
                line.show("bytes kept: " + result.row.name());
                try {
                    for (var build : List.of(BuildJvms.Name.BEFORE, BuildJvms.Name.NOW)) {
                        result.keptBytes.put(build, jvms.keptBytes(result.row, build));
                    }
                } catch (RowFailure failed) {
                    result.keptFailure = failed;
                }
            }
        }
    }
}
