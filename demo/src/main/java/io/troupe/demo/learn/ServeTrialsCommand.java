package io.troupe.demo.learn;

import io.troupe.demo.terminal.OptionRange;
import io.troupe.demo.terminal.WorldLoader;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.learn.TrialServer;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.RandomWorld;
import java.io.BufferedInputStream;
import java.io.BufferedOutputStream;
import java.io.FileDescriptor;
import java.io.FileInputStream;
import java.io.FileOutputStream;
import java.io.IOException;
import java.nio.file.Path;
import java.util.concurrent.Callable;
import java.util.function.LongFunction;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

/** {@code troupe learn serve}: lets another program step worlds over standard input and output. */
@Command(
        name = "serve",
        description = "Steps worlds for another program, such as one in Python, over standard input and output.",
        footer = {"", "The frames are documented in docs/guide/17-a-world-as-a-library.md."},
        mixinStandardHelpOptions = true,
        showDefaultValues = true)
final class ServeTrialsCommand implements Callable<Integer> {
    private static final double BOXES_PER_M2 = 0.1;
    private static final double CELL_M = 2;
    private static final double ROOM_M = 5;
    private static final double JITTER_M = 0.02;
    private static final double JITTER_RAD = 2 * StrictMath.PI / 180;

    /** Random worlds, by the length of a side. */
    enum Kind {
        ARENA,
        MAZE,
        OFFICE,
        CAVE;

        private RandomWorld build(long seed, double sideM) {
            int cells = Math.max(1, (int) (sideM / CELL_M));
            int rooms = Math.max(1, (int) (sideM / ROOM_M));
            return switch (this) {
                case ARENA -> RandomWorld.arena(seed, sideM, BOXES_PER_M2);
                case MAZE -> RandomWorld.maze(seed, cells, cells, CELL_M);
                case OFFICE -> RandomWorld.office(seed, rooms, rooms);
                case CAVE -> RandomWorld.cave(seed, sideM);
            };
        }
    }

    @Spec
    private CommandSpec spec;

    @Option(names = "--random", paramLabel = "KIND", description = "random worlds: ${COMPLETION-CANDIDATES}")
    private Kind kind = Kind.ARENA;

    @Option(names = "--side", paramLabel = "M", description = "length of a random world")
    private double sideM = 8;

    @Option(names = "--robots", paramLabel = "N", description = "robots in each random world")
    private int robots = 1;

    @Option(
            names = "--world",
            paramLabel = "FILE",
            description = "a world file instead; the seed shifts its start poses by up to 2 cm and 2 degrees")
    private @Nullable Path file;

    @Option(names = "--worlds", paramLabel = "N", description = "number of worlds")
    private int worlds = 1;

    @Option(names = "--threads", paramLabel = "N", description = "threads that step worlds; 0 = as many as cores")
    private int threads;

    @Mixin
    private WorldLoader loader;

    @Override
    public Integer call() throws IOException {
        OptionRange.check(spec, "--robots", robots, 1, 1_000);
        OptionRange.check(spec, "--worlds", worlds, 1, 10_000);
        OptionRange.check(spec, "--threads", threads, 0, 256);
        int cores = threads > 0 ? threads : Runtime.getRuntime().availableProcessors();
        try (var server = server(cores);
                var in = new BufferedInputStream(new FileInputStream(FileDescriptor.in));
                var out = new BufferedOutputStream(new FileOutputStream(FileDescriptor.out))) {
            server.serve(in, out);
        }
        return 0;
    }

    private TrialServer server(int cores) {
        LongFunction<WorldSpec> build = seed -> kind.build(seed, sideM).withRobots(robots);
        WorldSettings settings = WorldSettings.defaults();
        if (file != null) {
            WorldSpec world = loader.read(file).world();
            build = seed -> world;
            settings = settings.withJitter(JITTER_M, JITTER_RAD);
        }
        try {
            return TrialServer.of(worlds, build, settings, cores);
        } catch (IllegalArgumentException wrong) {
            throw new ParameterException(spec.commandLine(), wrong.getMessage());
        }
    }
}
