package io.troupe.bench;

import io.troupe.bench.BenchmarkCommand.AtLeastOne;
import java.nio.file.Path;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Option;

/** The options that all comparisons have: contenders take turns, in rounds. Each comparison has its own defaults. */
public final class ComparisonOptions {
    @Option(
            names = "--rounds",
            paramLabel = "N",
            converter = AtLeastOne.class,
            description = "how many turns each contender has in each workload")
    public int rounds;

    @Option(
            names = "--warm-up",
            paramLabel = "MILLIS",
            converter = AtLeastOne.class,
            description = "for each contender and workload")
    public int warmUpMillis;

    @Option(names = "--seed", paramLabel = "N", description = "of the order of the turns")
    public long seed = 1;

    @Option(names = "--figure", paramLabel = "FILE", description = "draws the results, as SVG")
    public @Nullable Path figure;

    /** Options with these defaults. */
    public ComparisonOptions(int rounds, int warmUpMillis) {
        this.rounds = rounds;
        this.warmUpMillis = warmUpMillis;
    }
}
