package io.troupe.bench;

import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import org.jspecify.annotations.Nullable;

/** The command line of {@link CompareActors}. */
record CompareOptions(
        int rounds,
        int warmUpMillis,
        long seed,
        List<String> contenders,
        List<Workload> workloads,
        @Nullable Path figure) {
    static final String USAGE = """
            Options, each followed by its value:
              --rounds 20        how many turns each contender has in each workload
              --warm-up 2000     milliseconds for each contender and workload
              --seed 1           of the order of the turns
              --only a,b         these contenders (and the limit): %s
              --workloads a,b    these workloads: %s
              --figure file.svg  draws the ratios
            """.formatted(
            String.join(",", Contenders.labels()),
            String.join(
                    ",", Arrays.stream(Workload.values()).map(Workload::label).toList()));

    static CompareOptions parse(String... args) {
        var options = new CompareOptions(20, 2_000, 1, Contenders.labels(), List.of(Workload.values()), null);
        if (args.length % 2 != 0) {
            throw new IllegalArgumentException("an option has no value: " + String.join(" ", args));
        }
        for (int i = 0; i < args.length; i += 2) {
            options = options.with(args[i], args[i + 1]);
        }
        return options;
    }

    private CompareOptions with(String option, String value) {
        return switch (option) {
            case "--rounds" ->
                new CompareOptions(positive(option, value), warmUpMillis, seed, contenders, workloads, figure);
            case "--warm-up" ->
                new CompareOptions(rounds, positive(option, value), seed, contenders, workloads, figure);
            case "--seed" ->
                new CompareOptions(rounds, warmUpMillis, Long.parseLong(value), contenders, workloads, figure);
            case "--only" -> new CompareOptions(rounds, warmUpMillis, seed, withLimit(value), workloads, figure);
            case "--workloads" ->
                new CompareOptions(
                        rounds,
                        warmUpMillis,
                        seed,
                        contenders,
                        Arrays.stream(value.split(",")).map(Workload::named).toList(),
                        figure);
            case "--figure" -> new CompareOptions(rounds, warmUpMillis, seed, contenders, workloads, Path.of(value));
            default -> throw new IllegalArgumentException("no option " + option);
        };
    }

    private static int positive(String option, String value) {
        int number = Integer.parseInt(value);
        if (number < 1) {
            throw new IllegalArgumentException(option + " is " + value + ", expected 1 or more");
        }
        return number;
    }

    private static List<String> withLimit(String names) {
        var chosen = new ArrayList<>(List.of(Contenders.LIMIT.label()));
        for (String name : names.split(",")) {
            if (!chosen.contains(Contenders.named(name).label())) {
                chosen.add(name);
            }
        }
        return List.copyOf(chosen);
    }
}
