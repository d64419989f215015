package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.common.text.NamedColours;
import io.troupe.player.PlayerException;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceObserver;
import io.troupe.services.subsumption.SubsumptionRun;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.ScenarioReader;
import java.nio.file.Path;
import java.util.Optional;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/** A failure is reported after the tick in which it occurs, in each of the three modes. */
@Timeout(60)
class FaultsInEveryModeTest {
    private static final int GOOD_CYCLES = 5;

    private static SubsumptionRun.Settings settings(Mode mode, Simulation simulation, Service ofRobot2, int port) {
        var table = SubsumptionTable.forRobots(2)
                .when(NamedColours.BLUE, Service.WALL_FOLLOWER, ofRobot2)
                .allowFinal()
                .build();
        return new SubsumptionRun.Settings(
                mode, "localhost", port, table, simulation.clock(), ServiceObserver.NONE, (state, seenBy) -> {});
    }

    private static Simulation open() {
        return Simulation.open(ScenarioReader.read(Path.of("worlds", "paper-arena.world")), WorldSettings.DEFAULT);
    }

    @ParameterizedTest
    @EnumSource
    void behaviourThatThrows_isThrownByCheck_andItsRobotStands(Mode mode) throws InterruptedException {
        var failing = new Service("failing", true, () -> {
            var cycles = new int[1];
            return senses -> {
                if (cycles[0]++ == GOOD_CYCLES) {
                    throw new IllegalStateException("out of ideas");
                }
                return Optional.of(new Velocity(0.1, 0));
            };
        });
        try (var simulation = open();
                var run = SubsumptionRun.start(settings(mode, simulation, failing, 6665))) {
            int readings = mode == Mode.SYNC ? 2 * GOOD_CYCLES + 1 : GOOD_CYCLES;
            for (int tick = 0; tick < readings; tick++) {
                simulation.tick();
                run.check();
            }
            simulation.tick();
            assertThatThrownBy(run::check)
                    .isInstanceOf(IllegalStateException.class)
                    .hasMessage("out of ideas");
            var stood = simulation.latest().robots().get(1).pose();
            assertThat(simulation.tick().robots().get(1).pose()).isEqualTo(stood);
        }
    }

    @ParameterizedTest
    @EnumSource
    void portWithoutAWorld_isToldAtTheStart(Mode mode) {
        try (var simulation = open()) {
            var nowhere = settings(mode, simulation, Service.SPACE_WANDERER, 6664);
            assertThatThrownBy(() -> SubsumptionRun.start(nowhere))
                    .isInstanceOf(PlayerException.class)
                    .hasMessageContaining("6665");
        }
    }
}
