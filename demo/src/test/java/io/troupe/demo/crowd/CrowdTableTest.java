package io.troupe.demo.crowd;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceCatalogue;
import io.troupe.services.subsumption.State;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.services.subsumption.SubsumptionTableException;
import io.troupe.services.subsumption.SubsumptionTableReader;
import io.troupe.sim.worldfile.CrowdWorld;
import java.nio.file.Path;
import java.util.HashSet;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class CrowdTableTest {
    private static SubsumptionTable table(int robots, int colours, int services) {
        return CrowdTable.of(
                robots, CrowdWorld.colours(colours), services, CrowdTable.HOLD_SECONDS, CornerStyle.FORWARD);
    }

    @ParameterizedTest
    @CsvSource({"1, 1, 1", "1, 8, 2", "1, 5, 7", "2, 3, 2", "7, 8, 3", "50, 8, 3", "50, 100, 100", "1000, 8, 20"})
    void table_ofAnySize_hasAStateForEachColourAndSomebodyInItWhoLooksForColours(
            int robots, int colours, int services) {
        SubsumptionTable table = table(robots, colours, services);

        assertThat(table.robots()).isEqualTo(robots);
        assertThat(table.holdSeconds()).isEqualTo(CrowdTable.HOLD_SECONDS);
        assertThat(table.states()).extracting(State::colour).isEqualTo(CrowdWorld.colours(colours));
        assertThat(table.states()).allMatch(State::canEnd);
        assertThat(table.services().size()).isLessThanOrEqualTo(services + (robots == 1 ? 1 : 0));
    }

    @Test
    void state_withRobotsEnough_hasAllServices() {
        for (State state : table(20, 6, 20).states()) {
            assertThat(new HashSet<>(state.services())).hasSize(20);
        }
    }

    @Test
    void nextState_movesAllServicesOn() {
        List<State> states = table(9, 3, 3).states();
        for (int robot = 0; robot < 9; robot++) {
            assertThat(states.get(1).services().get(robot))
                    .isNotEqualTo(states.get(0).services().get(robot));
        }
    }

    @Test
    void loneWallFollower_whomNobodyLooksForColoursBeside_wandersInstead() {
        assertThat(table(1, 2, 2).states())
                .extracting(state -> state.services().getFirst())
                .containsOnly(Service.SPACE_WANDERER);
    }

    @Test
    void tableOfTheLargestCrowd_canBeAFile() {
        String states = "\nstate blue : * = spaceWanderer\nstate red : * = spaceWanderer";

        var table = SubsumptionTableReader.parse(
                "robots " + CrowdWorld.MOST_ROBOTS + states, Path.of("largest"), ServiceCatalogue.standard());

        assertThat(table.robots()).isEqualTo(CrowdWorld.MOST_ROBOTS);
        assertThatThrownBy(() -> SubsumptionTableReader.parse(
                        "robots " + (CrowdWorld.MOST_ROBOTS + 1) + states,
                        Path.of("larger"),
                        ServiceCatalogue.standard()))
                .isInstanceOf(SubsumptionTableException.class)
                .hasMessageContaining("a number of robots, 1 to " + CrowdWorld.MOST_ROBOTS);
    }
}
