package io.troupe.demo.evaluate;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.Simulation;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;

class PaperWorldTest {
    private static final PaperWorld WORLD = PaperWorld.read(Path.of("worlds", "paper-arena.cfg"));

    private static String robots(long seed) {
        try (var simulation = Simulation.open(WORLD.scenario(), PaperWorld.settings(seed))) {
            return simulation.tick().robots().toString();
        }
    }

    @Test
    void seed_movesTheStartPoses() {
        assertThat(robots(1)).isEqualTo(robots(1)).isNotEqualTo(robots(2));
    }
}
