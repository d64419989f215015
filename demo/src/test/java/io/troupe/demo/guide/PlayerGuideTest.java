package io.troupe.demo.guide;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.Simulation;
import io.troupe.sim.SimulationRunner;
import io.troupe.sim.Snapshot;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.ScenarioReader;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The samples of docs/guide/04-bring-your-player-program.md. */
@Timeout(60)
class PlayerGuideTest {
    @Test
    void program_andWorld_inOneJvm() {
        var scenario = ScenarioReader.read(Path.of("worlds", "paper-arena.cfg"));
        Snapshot end;
        try (var simulation = Simulation.open(scenario, WorldSettings.DEFAULT);
                var runner = SimulationRunner.start(simulation, 1, snapshot -> {})) {
            KeepAway.run(6665, 200);
            end = simulation.latest();
            assertThat(runner.isRunning()).isTrue();
        }
        var start = scenario.world().robots().getFirst().pose();
        var pose = end.robots().getFirst().pose();
        assertThat(end.timeMicros()).isGreaterThanOrEqualTo(19_900_000);
        assertThat(StrictMath.hypot(pose.x() - start.x(), pose.y() - start.y())).isGreaterThan(1);
    }
}
