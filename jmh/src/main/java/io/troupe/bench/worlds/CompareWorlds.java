package io.troupe.bench.worlds;

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

/**
 * Compares our simulator with two physics engines that carry the same robots.
 *
 * <p><b>Role.</b> Every contender runs in a separate JVM. They take turns of fixed wall-clock time in random order
 * while the others wait, so that all of them run under the same conditions. The result is the ratio to ours in the same
 * round.
 *
 * <p><b>Errors.</b> The comparison ends if contenders do not sense the same after a second, or if one fails.
 */
public final class CompareWorlds {
    private final WorldsOptions options;
    private final Random random;
    private final WorldsResults results = new WorldsResults(new TreeMap<>(), new TreeMap<>());

    private CompareWorlds(WorldsOptions options) {
        this.options = options;
        random = new Random(options.seed());
    }

    public static void main(String[] args) throws IOException {
        WorldsOptions options;
        try {
            options = WorldsOptions.parse(args);
        } catch (IllegalArgumentException wrong) {
            System.err.println(wrong.getMessage());
            System.err.print(WorldsOptions.USAGE);
            System.exit(2);
            return;
        }
        new CompareWorlds(options).run();
    }

    private void run() throws IOException {
        agree();
        measureRetained();
        List<WorldPipe> pipes = new ArrayList<>();
        try {
            for (WorldKind kind : options.only()) {
                pipes.add(new WorldPipe(kind));
            }
            for (int robots : options.robots()) {
                results.turns().put(robots, compare(robots, pipes));
            }
        } finally {
            pipes.forEach(WorldPipe::close);
        }
        System.out.print(new WorldsReport(options, results).table());
        var figure = options.figure();
        if (figure != null) {
            Files.writeString(figure, WorldsDrawing.of(results).svg());
        }
    }

    private void agree() {
        for (int robots : options.robots()) {
            if (robots <= WorldsOptions.MANY_ROBOTS) {
                progress("comparing the readings of " + robots);
                Agreement agreement = Agreement.check(robots);
                progress("");
                System.out.printf(
                        Locale.ROOT,
                        "%,d robots: after one second the sonars of all contenders agree within %.2f mm, but for %d rays that graze a corner%n",
                        robots,
                        1000 * agreement.largestM(),
                        agreement.grazing());
            }
        }
        System.out.println();
    }

    /** Measures the retained bytes in a separate JVM. */
    private void measureRetained() throws IOException {
        try (var pipe = new WorldPipe(WorldKind.TROUPE)) {
            for (int robots : options.robots()) {
                if (robots > 1) {
                    progress("memory of " + robots);
                    results.retainedBytes().put(robots, pipe.retainedBytes(robots));
                }
            }
        }
        progress("");
    }

    private Map<WorldKind, List<WorldTurn>> compare(int robots, List<WorldPipe> pipes) throws IOException {
        Map<WorldKind, List<WorldTurn>> turns = new EnumMap<>(WorldKind.class);
        for (WorldPipe pipe : pipes) {
            progress(robots + " robots: warming up " + pipe.kind().label());
            turns.put(pipe.kind(), new ArrayList<>());
            pipe.build(robots);
            pipe.turn(isShort(robots, pipe) ? 1 : options.warmUpMillis());
        }
        for (int round = 1; round <= options.rounds(); round++) {
            progress(robots + " robots: round " + round + " of " + options.rounds());
            var order = new ArrayList<>(pipes);
            Collections.shuffle(order, random);
            for (WorldPipe pipe : order) {
                if (round <= WorldsOptions.FEW_ROUNDS || !isShort(robots, pipe)) {
                    turns.get(pipe.kind()).add(pipe.turn(options.turnMillis()));
                }
            }
        }
        for (WorldPipe pipe : pipes) {
            pipe.drop();
        }
        progress("");
        return turns;
    }

    /** With many robots the other contenders get only a few turns. */
    private static boolean isShort(int robots, WorldPipe pipe) {
        return robots > WorldsOptions.MANY_ROBOTS && !pipe.kind().isOurs();
    }

    private static void progress(String text) {
        System.err.printf("\r%-60s", text);
        if (text.isEmpty()) {
            System.err.print("\r");
        }
    }
}
