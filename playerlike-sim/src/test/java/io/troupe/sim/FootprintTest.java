package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;

import com.sun.management.ThreadMXBean;
import io.troupe.sim.model.WorldSpec;
import java.lang.management.ManagementFactory;
import java.lang.management.MemoryUsage;
import java.lang.ref.Reference;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.parallel.Isolated;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Heap use of a world. */
@Isolated("measures the heap")
class FootprintTest {
    private static final ThreadMXBean THREADS = (ThreadMXBean) ManagementFactory.getThreadMXBean();
    private static final int ATTEMPTS = 20;

    /**
     * The only allocations are growing pools, when more bodies are near each other than ever before; they become rarer.
     */
    @ParameterizedTest
    @ValueSource(ints = {2, 100})
    void warmWorld_advancesWithoutGarbage(int robots) {
        World world =
                World.create(Arena.crowd(robots, 1, Specs.RED, Specs.GREEN, Specs.BLUE), WorldSettings.defaults());
        world.advance(1_200, Arena::wander);
        int most = robots == 2 ? 0 : 7;
        long grown = intervalsWithGarbage(world);
        for (int attempt = 1; attempt < ATTEMPTS && grown > most; attempt++) { // compiled late on a busy machine
            grown = intervalsWithGarbage(world);
        }
        assertThat(grown).as("of 400 intervals with any garbage").isLessThanOrEqualTo(most);
    }

    private static long intervalsWithGarbage(World world) {
        var allocated = new long[401];
        long first = world.tick();
        world.advance(allocated.length, view -> {
            allocated[(int) (view.tick() - first)] = THREADS.getCurrentThreadAllocatedBytes();
            Arena.wander(view);
        });
        return IntStream.range(1, allocated.length)
                .filter(i -> allocated[i] > allocated[i - 1])
                .count();
    }

    @Test
    void robot_takesLessThanEightKilobytes() {
        WorldSpec few = Arena.crowd(64, 1, Specs.RED);
        WorldSpec many = Arena.crowd(1_024, 1, Specs.RED);
        size(few); // frees what earlier tests have left
        long perRobot = (size(many) - size(few)) / (1_024 - 64);
        assertThat(perRobot).as("bytes per robot").isBetween(1_000L, 8_000L);
    }

    /** Heap bytes freed when this world is dropped. */
    private static long size(WorldSpec spec) {
        World world = World.create(spec, WorldSettings.defaults());
        world.advance(20, Arena::wander);
        long with = usedAfterCollection();
        Reference.reachabilityFence(world);
        world = null;
        return with - usedAfterCollection();
    }

    private static long usedAfterCollection() {
        long least = Long.MAX_VALUE;
        for (int i = 0; i < 3; i++) {
            System.gc();
            MemoryUsage heap = ManagementFactory.getMemoryMXBean().getHeapMemoryUsage();
            least = Math.min(least, heap.getUsed());
        }
        return least;
    }
}
