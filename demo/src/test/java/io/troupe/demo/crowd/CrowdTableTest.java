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
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class CrowdTableTest {
    private static SubsumptionTable table(int robots, int colours, int services) {
        var all = CrowdWorld.colours(colours);
        return CrowdTable.of(robots, all, services, CrowdTable.HOLD_SECONDS, CornerStyle.FORWARD);
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
    void states_withRobotsEnough_haveAllServices_whichTheNextStateMovesOn() {
        assertThat(table(20, 6, 20).states())
                .hasSize(6)
                .allSatisfy(state -> assertThat(new HashSet<>(state.services())).hasSize(20));
        var states = table(9, 3, 3).states();
        assertThat(states.get(1).services())
                .hasSize(9)
                .zipSatisfy(states.get(0).services(), (next, service) -> assertThat(next)
                        .isNotEqualTo(service));
    }

    @Test
    void loneWallFollower_whomNobodyLooksForColoursBeside_wandersInstead() {
        assertThat(table(1, 2, 2).states())
                .extracting(state -> state.services().getFirst())
                .containsOnly(Service.SPACE_WANDERER);
    }

    private static SubsumptionTable read(int robots) {
        String states = "\nstate blue : * = spaceWanderer\nstate red : * = spaceWanderer";
        return SubsumptionTableReader.parse("robots " + robots + states, Path.of("largest"), ServiceCatalogue.standard());
    }

    @Test
    void tableOfTheLargestCrowd_canBeAFile() {
        int most = CrowdWorld.MOST_ROBOTS;
        assertThat(read(most).robots()).isEqualTo(most);
        assertThatThrownBy(() -> read(most + 1))
                .isInstanceOf(SubsumptionTableException.class)
                .hasMessageContaining("a number of robots, 1 to " + most);
    }
}
