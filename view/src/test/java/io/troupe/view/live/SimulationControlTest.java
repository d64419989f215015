package io.troupe.view.live;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.player.PlayerClient;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.sim.Pace;
import io.troupe.sim.Simulation;
import io.troupe.sim.SimulationRunner;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.Pose;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Commands of viewers in a served world. */
@Timeout(60)
class SimulationControlTest {
    @Test
    void interventions_areCarriedOut_andListedOnce_exceptThoseThatAreImpossible() {
        try (var simulation = Simulation.open(LiveRuns.ARENA, WorldSettings.defaults())) {
            var control = new SimulationControl(simulation, 1);
            var place = new ViewCommand.Place(0, new Pose(-3, 0, 1));
            var box = new ViewCommand.PutBox(new ColouredBox(2, 0xFF0000, 0, 1));
            control.submit(place);
            control.submit(box);
            assertThatThrownBy(() -> control.submit(new ViewCommand.Place(0, new Pose(1000, 0, 0))))
                    .isInstanceOf(IllegalArgumentException.class);
            var after = simulation.tick();
            assertThat(after.robots().getFirst().pose()).isEqualTo(place.pose());
            assertThat(after.boxes()).containsExactly(box.box());
            assertThat(control.ticked()).isEqualTo(List.of(place, box));
            assertThat(control.ticked()).isEmpty();
        }
    }

    @Test
    void world_waitsForClients_whileItsRunnerHasNone() {
        try (var simulation = Simulation.open(LiveRuns.ARENA, WorldSettings.defaults())) {
            simulation.lockStep(false);
            var control = new SimulationControl(simulation, 1);
            assertThat(control.waitsFor()).as("before it has begun to run").isEmpty();
            try (var runner = SimulationRunner.start(simulation, 1, snapshot -> {}, new Pace.RealTime(1))) {
                control.runner(runner);
                awaitWaitsFor(control, "clients");
                var client = new PlayerClient("localhost", 6665);
                try {
                    client.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
                    client.readAll();
                    awaitWaitsFor(control, "");
                } finally {
                    client.close();
                }
                awaitWaitsFor(control, "clients");
            }
        }
    }

    private static void awaitWaitsFor(SimulationControl control, String wanted) {
        while (!control.waitsFor().equals(wanted)) {
            Thread.onSpinWait();
        }
    }
}
