package io.troupe.demo.learn;

import io.troupe.demo.terminal.OptionRange;
import io.troupe.demo.terminal.OutputDirectory;
import java.io.IOException;
import java.nio.file.Path;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

/** Command line options of trials of the wall follower in random arenas. */
final class TrialOptions {
    private static final int STEPS_PER_SECOND = 10;
    private static final int MOST_SECONDS = 3_600;

    private final int mostArenas;

    @Spec(Spec.Target.MIXEE)
    private CommandSpec spec;

    @Option(names = "--arenas", paramLabel = "N", description = "random arenas")
    private int arenas;

    @Option(names = "--seconds", paramLabel = "N", description = "simulated time of a trial")
    private int seconds;

    @Option(names = "--seed", paramLabel = "N", description = "of everything random")
    private long seed = 1;

    @Option(names = "--out", paramLabel = "DIR", description = "where the table and the figure go")
    private Path out = Path.of("out");

    /**
     * Options with these values unless others are given.
     *
     * @param mostArenas that may be asked for
     */
    TrialOptions(int arenas, int mostArenas, int seconds) {
        this.arenas = arenas;
        this.mostArenas = mostArenas;
        this.seconds = seconds;
    }

    /** Refuses numbers that are out of range, and makes the output directory. */
    void check() throws IOException {
        OptionRange.check(spec, "--arenas", arenas, 1, mostArenas);
        OptionRange.check(spec, "--seconds", seconds, 1, MOST_SECONDS);
        OutputDirectory.make(spec, out);
    }

    int arenas() {
        return arenas;
    }

    /** Length of a trial. */
    int steps() {
        return seconds * STEPS_PER_SECOND;
    }

    long seed() {
        return seed;
    }

    /** A file of this name in the output directory. */
    Path file(String name) {
        return out.resolve(name);
    }
}
