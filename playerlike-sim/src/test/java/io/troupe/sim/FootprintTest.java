package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;

import com.sun.management.ThreadMXBean;
import io.troupe.sim.scenario.WorldSpec;
import java.lang.management.ManagementFactory;
import java.lang.ref.Reference;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;
import org.junit.jupiter.api.Test;

/** What a world takes of the heap. */
class FootprintTest {
    private static final ThreadMXBean THREADS = (ThreadMXBean) ManagementFactory.getThreadMXBean();

    @ParameterizedTest
    @ValueSource(ints = {2, 100})
    void warmWorld_advancesWithoutGarbage(int robots) {
        World world = World.create(Tiles.world(robots, 1, Specs.RED, Specs.GREEN, Specs.BLUE), WorldSettings.DEFAULT);
        var bytes = new long[2];
        world.advance(2_500, view -> {
            if (view.tick() == 2_000) {
                bytes[0] = THREADS.getCurrentThreadAllocatedBytes();
            }
            if (view.tick() == 2_499) {
                bytes[1] = THREADS.getCurrentThreadAllocatedBytes();
            }
            Tiles.wander(view);
        });
        assertThat(bytes[1] - bytes[0]).as("bytes in 4,990 steps").isZero();
    }

    @Test
    void robot_takesLessThanEightKilobytes() {
        WorldSpec few = Tiles.world(64, 1, Specs.RED);
        WorldSpec many = Tiles.world(1_024, 1, Specs.RED);
        long perRobot = (size(many) - size(few)) / (1_024 - 64);
        assertThat(perRobot).as("bytes per robot").isBetween(1_000L, 8_000L);
    }

    /** What the heap loses when this world is dropped. */
    private static long size(WorldSpec spec) {
        World world = World.create(spec, WorldSettings.DEFAULT);
        world.advance(20, Tiles::wander);
        long with = usedAfterCollection();
        Reference.reachabilityFence(world);
        world = null;
        return with - usedAfterCollection();
    }

    private static long usedAfterCollection() {
        long least = Long.MAX_VALUE;
        for (int i = 0; i < 3; i++) {
            System.gc();
            least = Math.min(least, ManagementFactory.getMemoryMXBean().getHeapMemoryUsage().getUsed());
        }
        return least;
    }
}
