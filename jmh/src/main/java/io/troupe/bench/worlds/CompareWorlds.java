package io.troupe.bench.worlds;

import io.troupe.bench.BenchmarkCommand;
import io.troupe.bench.BenchmarkCommand.AtLeastOne;
import io.troupe.bench.ComparisonOptions;
import io.troupe.tools.ProgressLine;
import java.io.IOException;
import java.nio.file.Files;
import java.util.ArrayList;
import java.util.Collections;
import java.util.EnumMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Random;
import java.util.TreeMap;
import java.util.concurrent.Callable;
import java.util.stream.Stream;
import picocli.CommandLine.Command;
import picocli.CommandLine.Help.Visibility;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

/**
 * Compares our simulator with two physics engines that carry the same robots.
 *
 * <p><b>Role.</b> Every contender runs in a separate JVM. They take turns of fixed wall-clock time in random order
 * while the others wait, so that all of them run under the same conditions. The result is the ratio to ours in the same
 * round.
 *
 * <p><b>Errors.</b> The comparison ends if contenders do not sense the same after a second, or if one fails.
 */
@Command(
        name = "CompareWorlds",
        description = "Compares our simulator with two physics engines that carry the same robots.",
        showDefaultValues = true)
public final class CompareWorlds implements Callable<Integer> {
    /** Above this number, the other contenders get {@link #FEW_ROUNDS} turns and a warm-up of one interval. */
    private static final int MANY_ROBOTS = 1_000;

    private static final int FEW_ROUNDS = 3;

    @Option(
            names = "--robots",
            paramLabel = "N",
            split = ",",
            converter = AtLeastOne.class,
            description = "how many robots")
    List<Integer> robots = List.of(1, 2, 10, 100, 1_000, 10_000);

    @Option(names = "--scene", paramLabel = "NAME", description = "${COMPLETION-CANDIDATES}")
    BuildScene scene = BuildScene.FULL;

    @Mixin
    final ComparisonOptions comparison = new ComparisonOptions(9, 3_000);

    @Option(names = "--turn", paramLabel = "MILLIS", converter = AtLeastOne.class, description = "of a turn")
    int turnMillis = 500;

    @Option(
            names = "--only",
            paramLabel = "NAME",
            split = ",",
            converter = WorldKind.Converter.class,
            description = "these contenders, and troupe")
    List<WorldKind> only = List.of(WorldKind.values());

    private final WorldsResults results = new WorldsResults(new TreeMap<>(), new TreeMap<>());

    /** Replaces the options before it, and is replaced by those after it. */
    @Option(
            names = "--quick",
            description = "as --robots 1,2,10,100 --rounds 3 --turn 200 --warm-up 1000",
            showDefaultValue = Visibility.NEVER)
    private void quick(boolean chosen) {
        if (chosen) {
            robots = List.of(1, 2, 10, 100);
            comparison.rounds = 3;
            turnMillis = 200;
            comparison.warmUpMillis = 1_000;
        }
    }

    public static void main(String[] arguments) {
        System.exit(BenchmarkCommand.of(new CompareWorlds()).execute(arguments));
    }

    /** The numbers of robots, in ascending order. */
    List<Integer> robots() {
        return robots.stream().distinct().sorted().toList();
    }

    /** The contenders, ours first. */
    List<WorldKind> contenders() {
        return Stream.concat(Stream.of(WorldKind.TROUPE), only.stream())
                .distinct()
                .toList();
    }

    @Override
    public Integer call() throws IOException {
        try (var line = ProgressLine.open()) {
            agree(line);
            measureRetained(line);
            measureTurns(line);
        }
        System.out.print(new WorldsReport(scene, comparison.rounds, turnMillis, comparison.seed, results).table());
        if (comparison.figure != null) {
            Files.writeString(comparison.figure, WorldsDrawing.of(results).svg());
        }
        return 0;
    }

    private void measureTurns(ProgressLine line) throws IOException {
        var random = new Random(comparison.seed);
        List<WorldProcess> processes = new ArrayList<>();
        try {
            for (WorldKind kind : contenders()) {
                processes.add(new WorldProcess(kind));
            }
            for (int count : robots()) {
                results.turns().put(count, compare(count, processes, random, line));
            }
        } finally {
            processes.forEach(WorldProcess::close);
        }
    }

    private void agree(ProgressLine line) {
        for (int count : robots()) {
            if (count <= MANY_ROBOTS) {
                line.show("comparing the readings of " + count);
                Agreement agreement = Agreement.check(scene, count, contenders());
                line.interrupt(() -> System.out.printf(
                        Locale.ROOT,
                        "%s, %,d robots: after one second the ranges of all contenders agree within %.2f mm, but for %d rays that graze a corner%n",
                        scene,
                        count,
                        1000 * agreement.largestM(),
                        agreement.grazing()));
            }
        }
        System.out.println();
    }

    /** Measures the retained bytes in a separate JVM. */
    private void measureRetained(ProgressLine line) throws IOException {
        try (var process = new WorldProcess(WorldKind.TROUPE)) {
            for (int count : robots()) {
                if (count > 1) {
                    line.show("memory of " + count);
                    results.retainedBytes().put(count, process.retainedBytes(scene, count));
                }
            }
        }
    }

    private Map<WorldKind, List<WorldTurn>> compare(
            int count, List<WorldProcess> processes, Random random, ProgressLine line) throws IOException {
        Map<WorldKind, List<WorldTurn>> turns = new EnumMap<>(WorldKind.class);
        for (WorldProcess process : processes) {
            line.show(count + " robots: warming up " + process.kind().label());
            turns.put(process.kind(), new ArrayList<>());
            process.build(scene, count);
            process.turn(isShort(count, process) ? 1 : comparison.warmUpMillis);
        }
        for (int round = 1; round <= comparison.rounds; round++) {
            line.show(count + " robots: round " + round + " of " + comparison.rounds);
            var order = new ArrayList<>(processes);
            Collections.shuffle(order, random);
            for (WorldProcess process : order) {
                if (round <= FEW_ROUNDS || !isShort(count, process)) {
                    turns.get(process.kind()).add(process.turn(turnMillis));
                }
            }
        }
        for (WorldProcess process : processes) {
            process.drop();
        }
        return turns;
    }

    /** With many robots the other contenders get only a few turns. */
    private static boolean isShort(int count, WorldProcess process) {
        return count > MANY_ROBOTS && !process.kind().isOurs();
    }
}
