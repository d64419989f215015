package io.troupe.bench.worlds;

import io.troupe.sim.model.WorldSpec;
import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.io.PrintStream;
import java.lang.ref.Reference;
import java.nio.charset.StandardCharsets;
import org.jspecify.annotations.Nullable;

/**
 * The main class of a contender's JVM. It reads requests from standard input: {@code retained <robots>}, answered by
 * bytes per robot; {@code build <robots>}; {@code turn <millis>}, answered by a {@link WorldTurn}; and {@code drop}. It
 * exits at the end of its input.
 */
final class WorldProcess {
    private static final int COLLECTIONS = 4;
    /** Enough for everything that is created on demand. */
    private static final int SETTLING_INTERVALS = 5;

    private final WorldKind kind;
    private @Nullable BenchWorld world;
    private double lastFactor;

    private WorldProcess(WorldKind kind) {
        this.kind = kind;
    }

    public static void main(String[] args) throws IOException {
        PrintStream answers = System.out;
        System.setOut(System.err); // output of libraries must not mix with the answers
        var commands = new BufferedReader(new InputStreamReader(System.in, StandardCharsets.UTF_8));
        var process = new WorldProcess(WorldKind.named(args[0]));
        answers.println("ready");
        for (String line = commands.readLine(); line != null; line = commands.readLine()) {
            answers.println(process.answer(line.split(" ")));
        }
    }

    private String answer(String[] command) {
        return switch (command[0]) {
            case "retained" -> Double.toString(retainedBytes(Integer.parseInt(command[1])));
            case "build" -> {
                world = kind.create(TiledScene.of(Integer.parseInt(command[1])), true);
                lastFactor = 0;
                yield "built";
            }
            case "turn" -> {
                if (world == null) {
                    throw new IllegalStateException("a turn was asked for before a world was built");
                }
                WorldTurn turn = WorldTurn.run(world, Long.parseLong(command[1]) * 1_000_000, lastFactor);
                lastFactor = turn.factor();
                yield turn.line();
            }
            case "drop" -> {
                world = null;
                System.gc();
                yield "dropped";
            }
            default ->
                throw new IllegalArgumentException(
                        "a command is " + command[0] + ", expected retained, build, turn or drop");
        };
    }

    /**
     * What a robot adds to the heap: the difference between the world with all robots and the same world with the first
     * of them only.
     */
    private double retainedBytes(int robotCount) {
        WorldSpec full = TiledScene.of(robotCount);
        var lonely = new WorldSpec(
                full.name(), full.file(), full.intervalMillis(), full.robots().subList(0, 1), full.obstacles());
        keptBytes(lonely); // loads classes and fills pools that all worlds share
        return (double) (keptBytes(full) - keptBytes(lonely)) / (robotCount - 1);
    }

    private long keptBytes(WorldSpec spec) {
        long before = usedBytes();
        BenchWorld kept = kind.create(spec, true);
        kept.advance(SETTLING_INTERVALS);
        long after = usedBytes();
        Reference.reachabilityFence(kept);
        return after - before;
    }

    private static long usedBytes() {
        for (int i = 0; i < COLLECTIONS; i++) {
            System.gc();
        }
        return Runtime.getRuntime().totalMemory() - Runtime.getRuntime().freeMemory();
    }
}
