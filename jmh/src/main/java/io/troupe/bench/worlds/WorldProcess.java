package io.troupe.bench.worlds;

import io.troupe.sim.model.WorldSpec;
import io.troupe.tools.MeasuringJvm;
import io.troupe.tools.UsedHeap;
import java.io.IOException;
import java.lang.ref.Reference;
import java.util.List;
import org.jspecify.annotations.Nullable;

/** A contender in a separate JVM. Between two requests that process waits, and uses no processor. */
final class WorldProcess implements AutoCloseable {
    private final WorldKind kind;
    private final MeasuringJvm jvm;

    /** Starts the contender, and waits until it is ready. */
    WorldProcess(WorldKind kind) throws IOException {
        this.kind = kind;
        this.jvm = MeasuringJvm.running(Child.class, kind.label())
                .withOptions("-Xmx2g", "-XX:+UseSerialGC") // one thread, including the collector
                .start();
        try {
            ask("ready");
        } catch (IOException failure) {
            jvm.close();
            throw failure;
        }
    }

    WorldKind kind() {
        return kind;
    }

    double retainedBytes(BuildScene scene, int robotCount) throws IOException {
        return Double.parseDouble(ask("retained " + scene.name() + " " + robotCount));
    }

    void build(BuildScene scene, int robotCount) throws IOException {
        ask("build " + scene.name() + " " + robotCount);
    }

    WorldTurn turn(int millis) throws IOException {
        return WorldTurn.parse(ask("turn " + millis));
    }

    void drop() throws IOException {
        ask("drop");
    }

    private String ask(String request) throws IOException {
        return jvm.ask(request, kind.label() + ", " + request).getFirst();
    }

    /** Ends the process. */
    @Override
    public void close() {
        jvm.close();
    }

    /**
     * The main class of a contender's JVM. It answers {@code ready}; {@code retained <scene> <robots>} by bytes per
     * robot; {@code build <scene> <robots>}; {@code turn <millis>} by a {@link WorldTurn}; and {@code drop}.
     */
    static final class Child {
        /** Enough for everything that is created on demand. */
        private static final int SETTLING_INTERVALS = 5;

        private final WorldKind kind;
        private @Nullable BenchWorld world;
        private double lastFactor;

        private Child(WorldKind kind) {
            this.kind = kind;
        }

        public static void main(String[] args) throws Exception {
            MeasuringJvm.serve(() -> {
                var child = new Child(WorldKind.named(args[0]));
                return request -> List.of(child.answer(request.split(" ")));
            });
        }

        private String answer(String[] command) {
            return switch (command[0]) {
                case "ready" -> command[0];
                case "retained" -> Double.toString(retainedBytes(spec(command)));
                case "build" -> {
                    world = kind.create(spec(command), true);
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
                            "a command is " + command[0] + ", expected ready, retained, build, turn or drop");
            };
        }

        private static WorldSpec spec(String[] command) {
            return BuildScene.valueOf(command[1]).spec(Integer.parseInt(command[2]));
        }

        /**
         * What a robot adds to the heap: the difference between the world with all robots and the same world with the
         * first of them only.
         */
        private double retainedBytes(WorldSpec full) {
            var lonely = new WorldSpec(
                    full.name(),
                    full.file(),
                    full.intervalMillis(),
                    full.robots().subList(0, 1),
                    full.obstacles());
            keptBytes(lonely); // loads classes and fills pools that all worlds share
            return (double) (keptBytes(full) - keptBytes(lonely))
                    / (full.robots().size() - 1);
        }

        private long keptBytes(WorldSpec spec) {
            long before = UsedHeap.bytes();
            BenchWorld kept = kind.create(spec, true);
            kept.advance(SETTLING_INTERVALS);
            long after = UsedHeap.bytes();
            Reference.reachabilityFence(kept);
            return after - before;
        }
    }
}
