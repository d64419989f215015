package io.troupe.services.subsumption;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import org.junit.jupiter.api.Test;

class SubsumptionTableTest {
    private static final Service WF = Service.WALL_FOLLOWER;
    private static final Service SW = Service.SPACE_WANDERER;

    private final SubsumptionTable paper = SubsumptionTable.ofThePaper();

    @Test
    void table4_ofThePaper() {
        assertThat(paper.first()).isEqualTo(paper.state(Colours.BLUE).orElseThrow());
        assertThat(paper.state(Colours.BLUE).orElseThrow().services()).containsExactly(WF, SW);
        assertThat(paper.state(Colours.RED).orElseThrow().services()).containsExactly(SW, WF);
        assertThat(paper.state(Colours.GREEN).orElseThrow().services()).containsExactly(SW, SW);
        assertThat(paper.state(Colours.RED).orElseThrow().number()).isEqualTo(2);
    }

    @Test
    void blackOrangeAndTheStatesOwnColour_changeNothing() {
        State blue = paper.first();
        assertThat(paper.next(blue, Colours.BLACK)).isEmpty();
        assertThat(paper.next(blue, Colours.ORANGE)).isEmpty();
        assertThat(paper.next(blue, Colours.BLUE)).isEmpty();
        assertThat(paper.next(blue, Colours.GREEN)).map(State::number).hasValue(3);
    }

    @Test
    void stateThatNeverEnds_isRefusedWhenItCanBeReached() {
        var builder = SubsumptionTable.forRobots(2).when(Colours.BLUE, WF, SW).when(Colours.RED, WF, WF);
        assertThatThrownBy(builder::build)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("state 2 (red)")
                .hasMessageContaining("allowFinal()");
        assertThat(builder.allowFinal().build().state(Colours.RED)).isPresent();
    }

    @Test
    void firstStateThatNeverEnds_isTheOnlyOneThatCounts() {
        var builder = SubsumptionTable.forRobots(1).when(Colours.BLUE, WF).when(Colours.RED, WF);
        assertThatThrownBy(builder::build).hasMessageContaining("state 1 (blue) can be reached");
    }

    @Test
    void wrongNumberOfServices_andDoubleColours_areRefused() {
        var builder = SubsumptionTable.forRobots(2);
        assertThatThrownBy(() -> builder.when(Colours.RED, SW))
                .hasMessage("the state of red names 1 services, expected one for each of 2 robots");
        builder.when(Colours.RED, SW, SW);
        assertThatThrownBy(() -> builder.when(Colours.RED, WF, SW)).hasMessage("red leads to state 1 already");
        assertThatThrownBy(() -> SubsumptionTable.forRobots(0)).hasMessageContaining("expected 1 or more");
        assertThatThrownBy(() -> SubsumptionTable.forRobots(1).build()).hasMessageContaining("no state");
    }
}
