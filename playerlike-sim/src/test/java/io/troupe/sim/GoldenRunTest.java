package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.model.WorldSpec;
import org.junit.jupiter.api.Test;

/**
 * Runs of crowds with known checksums. A change of one of these checksums changes the trajectories of all worlds and
 * must be documented.
 */
class GoldenRunTest {
    private static long wandering(WorldSpec spec, int ticks) {
        World world = World.create(spec, WorldSettings.DEFAULT);
        var fingerprint = new Fingerprint();
        fingerprint.add(world.latest());
        for (int tick = 0; tick < ticks; tick++) {
            Tiles.wander(world.view());
            fingerprint.add(world.advance());
        }
        return fingerprint.value();
    }

    /** All robots drive on through every obstacle: piles of robots that push and rub. */
    private static long blind(WorldSpec spec, int ticks) {
        World world = World.create(spec, WorldSettings.DEFAULT);
        var fingerprint = new Fingerprint();
        fingerprint.add(world.latest());
        for (int tick = 0; tick < ticks; tick++) {
            for (int robot = 0; robot < spec.robots().size(); robot++) {
                world.command(robot, 0.4, 0.1 * (robot % 5 - 2));
            }
            fingerprint.add(world.advance());
        }
        return fingerprint.value();
    }

    @Test
    void camerasForThreeColours() {
        WorldSpec spec = Tiles.world(50, 1, Specs.RED, Specs.GREEN, Specs.BLUE);
        assertThat(wandering(spec, 300)).isEqualTo(0x1cd2381fL);
        assertThat(blind(spec, 300)).isEqualTo(0x77280fb8L);
    }

    @Test
    void camerasForAllColours() {
        WorldSpec spec = Tiles.world(50, 2);
        assertThat(wandering(spec, 300)).isEqualTo(0x92a140c4L);
        assertThat(blind(spec, 300)).isEqualTo(0x48e21de2L);
    }

    @Test
    void camerasForRobots() {
        WorldSpec spec = Tiles.world(50, 3, Specs.RED, Specs.ORANGE);
        assertThat(wandering(spec, 300)).isEqualTo(0xcf6da478L);
        assertThat(blind(spec, 300)).isEqualTo(0xf81338a5L);
    }

    @Test
    void fourTiles() {
        WorldSpec spec = Tiles.world(200, 4, Specs.BLUE);
        assertThat(wandering(spec, 100)).isEqualTo(0x3dc478bdL);
        assertThat(blind(spec, 100)).isEqualTo(0x08236865L);
    }
}
