package io.troupe.bench.worlds;

import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * The command line of {@link CompareWorlds}.
 *
 * @param robots the numbers of robots, in ascending order
 * @param only the contenders, ours first
 */
record WorldsOptions(
        List<Integer> robots,
        int rounds,
        int turnMillis,
        int warmUpMillis,
        long seed,
        List<WorldKind> only,
        @Nullable Path figure) {
    /** Above this number, the other contenders get {@link #FEW_ROUNDS} turns and a warm-up of one interval. */
    static final int MANY_ROBOTS = 1_000;

    static final int FEW_ROUNDS = 3;
    static final String USAGE = """
            Options, each but --quick followed by its value:
              --robots 1,2,10,100,1000,10000   how many robots
              --rounds 9                       how many turns each contender has for each number of robots
              --turn 500                       milliseconds of a turn
              --warm-up 3000                   milliseconds for each contender and number of robots
              --seed 1                         of the order of the turns
              --only a,b                       these contenders (and troupe): %s
              --figure file.svg                draws the curve
              --quick                          --robots 1,2,10,100 --rounds 3 --turn 200 --warm-up 1000
            """.formatted(String.join(",", WorldKind.labels()));

    private static final WorldsOptions DEFAULT = new WorldsOptions(
            List.of(1, 2, 10, 100, 1_000, 10_000), 9, 500, 3_000, 1, List.of(WorldKind.values()), null);

    static WorldsOptions parse(String... args) {
        var options = DEFAULT;
        for (int i = 0; i < args.length; i++) {
            if (args[i].equals("--quick")) {
                options = new WorldsOptions(
                        List.of(1, 2, 10, 100), 3, 200, 1_000, options.seed, options.only, options.figure);
            } else if (i + 1 < args.length) {
                options = options.with(args[i], args[++i]);
            } else {
                throw new IllegalArgumentException("an option has no value: " + args[i]);
            }
        }
        return options;
    }

    private WorldsOptions with(String option, String value) {
        return switch (option) {
            case "--robots" ->
                new WorldsOptions(numbers(option, value), rounds, turnMillis, warmUpMillis, seed, only, figure);
            case "--rounds" ->
                new WorldsOptions(robots, positive(option, value), turnMillis, warmUpMillis, seed, only, figure);
            case "--turn" ->
                new WorldsOptions(robots, rounds, positive(option, value), warmUpMillis, seed, only, figure);
            case "--warm-up" ->
                new WorldsOptions(robots, rounds, turnMillis, positive(option, value), seed, only, figure);
            case "--seed" ->
                new WorldsOptions(robots, rounds, turnMillis, warmUpMillis, Long.parseLong(value), only, figure);
            case "--only" -> new WorldsOptions(robots, rounds, turnMillis, warmUpMillis, seed, withOurs(value), figure);
            case "--figure" -> new WorldsOptions(robots, rounds, turnMillis, warmUpMillis, seed, only, Path.of(value));
            default -> throw new IllegalArgumentException("no option " + option);
        };
    }

    private static List<Integer> numbers(String option, String values) {
        return Arrays.stream(values.split(","))
                .map(value -> positive(option, value))
                .distinct()
                .sorted()
                .toList();
    }

    private static int positive(String option, String value) {
        int number = Integer.parseInt(value);
        if (number < 1) {
            throw new IllegalArgumentException(option + " is " + value + ", expected 1 or more");
        }
        return number;
    }

    private static List<WorldKind> withOurs(String names) {
        var chosen = new ArrayList<>(List.of(WorldKind.TROUPE));
        for (String name : names.split(",")) {
            if (!chosen.contains(WorldKind.named(name))) {
                chosen.add(WorldKind.named(name));
            }
        }
        return List.copyOf(chosen);
    }
}
