package io.troupe.services.subsumption;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.common.text.NamedColours;
import io.troupe.services.behaviour.SpaceWanderer;
import io.troupe.services.behaviour.TestBlobs;
import java.util.List;
import java.util.Optional;
import org.junit.jupiter.api.Test;

class SubsumptionTableTest {
    private static final Service WF = Service.WALL_FOLLOWER;
    private static final Service SW = Service.SPACE_WANDERER;

    private final SubsumptionTable paper = SubsumptionTable.ofThePaper();

    @Test
    void table4_ofThePaper() {
        assertThat(paper.first()).isEqualTo(paper.state(NamedColours.BLUE).orElseThrow());
        assertThat(paper.state(NamedColours.BLUE).orElseThrow().services()).containsExactly(WF, SW);
        assertThat(paper.state(NamedColours.RED).orElseThrow().services()).containsExactly(SW, WF);
        assertThat(paper.state(NamedColours.GREEN).orElseThrow().services()).containsExactly(SW, SW);
        assertThat(paper.state(NamedColours.RED).orElseThrow().number()).isEqualTo(2);
    }

    @Test
    void blackOrangeAndTheStatesOwnColour_changeNothing() {
        State blue = paper.first();
        assertThat(paper.next(blue, NamedColours.BLACK)).isEmpty();
        assertThat(paper.next(blue, NamedColours.ORANGE)).isEmpty();
        assertThat(paper.next(blue, NamedColours.BLUE)).isEmpty();
        assertThat(paper.next(blue, NamedColours.GREEN)).map(State::number).hasValue(3);
    }

    @Test
    void stateThatNeverEnds_isRefusedWhenItCanBeReached() {
        var builder =
                SubsumptionTable.forRobots(2).when(NamedColours.BLUE, WF, SW).when(NamedColours.RED, WF, WF);
        assertThatThrownBy(builder::build)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("state 2 (red)")
                .hasMessageContaining("allowFinal()");
        assertThat(builder.allowFinal().build().state(NamedColours.RED)).isPresent();
    }

    @Test
    void firstStateThatNeverEnds_isTheOnlyOneThatCounts() {
        var builder = SubsumptionTable.forRobots(1).when(NamedColours.BLUE, WF).when(NamedColours.RED, WF);
        assertThatThrownBy(builder::build).hasMessageContaining("state 1 (blue) can be reached");
    }

    @Test
    void wrongNumberOfServices_andDoubleColours_areRefused() {
        var builder = SubsumptionTable.forRobots(2);
        assertThatThrownBy(() -> builder.when(NamedColours.RED, SW))
                .hasMessage("the state of red names 1 services, expected one for each of 2 robots");
        builder.when(NamedColours.RED, SW, SW);
        assertThatThrownBy(() -> builder.when(NamedColours.RED, WF, SW)).hasMessage("red leads to state 1 already");
        assertThatThrownBy(() -> SubsumptionTable.forRobots(0)).hasMessageContaining("expected 1 or more");
        assertThatThrownBy(() -> SubsumptionTable.forRobots(1).build()).hasMessageContaining("no state");
    }

    @Test
    void reservedColours_leadToNoState() {
        assertThat(paper.ignored())
                .containsEntry(NamedColours.BLACK, "walls and robot 2")
                .containsEntry(NamedColours.ORANGE, "robot 1");
        var builder = SubsumptionTable.forRobots(1).when(NamedColours.BLACK, SW).ignoring(NamedColours.BLACK, "walls");
        assertThatThrownBy(builder::build)
                .hasMessage("black leads to state 1, but the table ignores it (walls), expected one or the other");
        assertThatThrownBy(() -> builder.ignoring(NamedColours.BLACK, "again")).hasMessage("black is ignored already");
        assertThatThrownBy(() -> builder.ignoring(NamedColours.RED, "robot #1")).hasMessageContaining("without '#'");
        assertThatThrownBy(() -> builder.ignoring(-1, "")).hasMessageContaining("expected 0x000000 to 0xFFFFFF");
    }

    @Test
    void whatIsDeclared_mustBeUsed() {
        assertThatThrownBy(() -> one().colour("sky", 0xFE).build())
                .hasMessageStartingWith("the colour sky is declared and leads to no state");
        assertThat(one().colour("sky", 0xFE).ignoring(0xFE, "").build().colourName(0xFE))
                .isEqualTo("sky");
        assertThatThrownBy(() -> one().service(WF).build())
                .hasMessageStartingWith("the service wallFollower is declared and in charge of no robot");
        assertThat(one().service(SW).build().services()).containsExactly(SW);
        assertThatThrownBy(() -> one().priority(0xFE, 2).build())
                .hasMessageStartingWith("#0000FE has priority 2 and leads to no");
    }

    @Test
    void names_belongToOneColour() {
        assertThatThrownBy(() -> one().colour("a", 1).colour("a", 2)).hasMessage("the colour a is declared already");
        assertThatThrownBy(() -> one().colour("a", 1).colour("b", 1))
                .hasMessage("the colour #000001 is called a already, and not b");
        assertThatThrownBy(() -> one().colour("two words", 1)).hasMessageContaining("expected a word");
        var table = one().colour("red", 0xFE0000).ignoring(0xFE0000, "").build();
        assertThat(table.colourName(0xFE0000)).isEqualTo("red");
        assertThat(table.colourName(NamedColours.RED)).isEqualTo("#FF0000");
    }

    @Test
    void twoServicesOfOneName_areRefused_unlessTheyAreEqual() {
        var backward = Service.wallFollower(io.troupe.services.behaviour.WallFollower.CornerStyle.BACKWARD);
        var builder = SubsumptionTable.forRobots(3).when(NamedColours.RED, WF, SW, backward);
        assertThatThrownBy(builder::build).hasMessageStartingWith("two different services are called wallFollower");
        var again = Service.wallFollower(io.troupe.services.behaviour.WallFollower.CornerStyle.FORWARD);
        assertThat(SubsumptionTable.forRobots(3)
                        .when(NamedColours.RED, WF, SW, again)
                        .build()
                        .services())
                .containsExactly(WF, SW);
    }

    /** A caller may look up a service for each robot at each switch. */
    @Test
    void services_areCollectedOnce_andFoundByName() {
        var table = SubsumptionTable.ofThePaper();
        assertThat(table.services()).isSameAs(table.services()).isUnmodifiable();
        assertThat(table.service("spaceWanderer")).containsSame(SW);
        assertThat(table.service("none")).isEmpty();
    }

    @Test
    void layers_areOneServiceWhereverTheyAreMade_andEachOfThemCanDrive() {
        Service avoid = SubsumptionTableReader.service("avoid = avoid", ServiceCatalogue.standard());
        var table = SubsumptionTable.forRobots(2)
                .when(NamedColours.RED, avoid.over(SW), avoid.over(SW))
                .build();
        assertThat(table.services()).containsExactly(avoid.over(SW));
        assertThatThrownBy(() -> SubsumptionTable.forRobots(1)
                        .when(NamedColours.RED, SW.over(avoid))
                        .build())
                .hasMessageContaining("never come to avoid, because spaceWanderer always drives");
        assertThatThrownBy(() -> SubsumptionTable.forRobots(1)
                        .when(NamedColours.RED, avoid.over(avoid).over(SW))
                        .build())
                .hasMessageContaining("name avoid twice");
    }

    @Test
    void statesThatNeverBegin_areRefused() {
        var builder = SubsumptionTable.forRobots(1)
                .allowFinal()
                .when(NamedColours.BLUE, WF)
                .when(NamedColours.RED, SW);
        assertThatThrownBy(builder::build)
                .hasMessageStartingWith("state 2 (red) never begins, because no robot in state 1 (blue)");
        assertThat(SubsumptionTable.forRobots(1)
                        .allowFinal()
                        .when(NamedColours.BLUE, WF)
                        .build()
                        .first()
                        .canEnd())
                .isFalse();
    }

    @Test
    void assignments_giveEachRobotOneService() {
        assertThat(Assignment.everyRobot(SW).robot(2, WF).services(3)).containsExactly(SW, WF, SW);
        assertThatThrownBy(() -> Assignment.none().robot(1, SW).services(2))
                .hasMessageStartingWith("robot 2 has no service");
        assertThatThrownBy(() -> Assignment.none().robots(1, 3, SW).robot(2, WF))
                .hasMessageStartingWith("robot 2 is given spaceWanderer and wallFollower without an order");
        assertThatThrownBy(() -> Assignment.everyRobot(SW).others(WF)).hasMessageContaining("without an order");
        assertThatThrownBy(() -> Assignment.everyRobot(SW).robot(3, WF).services(2))
                .hasMessageContaining("expected numbers up to 2");
        assertThatThrownBy(() -> Assignment.none().robot(0, SW)).hasMessageContaining("expected numbers from 1");
    }

    @Test
    void heldState_endsEarlyForAColourOfHigherPriorityOnly() {
        var table = SubsumptionTable.forRobots(1)
                .hold(2)
                .when(NamedColours.BLUE, SW)
                .when(NamedColours.RED, SW)
                .when(NamedColours.GREEN, SW)
                .priority(NamedColours.GREEN, 1)
                .build();
        State blue = table.first();
        assertThat(table.next(blue, NamedColours.RED, 1.9)).isEmpty();
        assertThat(table.next(blue, NamedColours.RED, 2)).map(State::colour).hasValue(NamedColours.RED);
        assertThat(table.next(blue, NamedColours.GREEN, 0)).map(State::colour).hasValue(NamedColours.GREEN);
        assertThat(table.next(table.state(NamedColours.GREEN).orElseThrow(), NamedColours.RED, 1))
                .isEmpty();
        var both = List.of(
                TestBlobs.of(NamedColours.RED, 500, 0),
                TestBlobs.of(NamedColours.GREEN, 20, 0),
                TestBlobs.of(NamedColours.BLACK, 900, 0));
        assertThat(table.ruleIn(blue).pick(both, 5)).hasValue(NamedColours.GREEN);
        assertThat(table.ruleIn(blue).pick(both.subList(0, 1), 1)).isEmpty();
        assertThatThrownBy(() -> SubsumptionTable.forRobots(1).hold(Double.NaN))
                .hasMessageContaining("expected 0 or more");
    }

    @Test
    void secondPriorityOfAColour_isRefused() {
        assertThatThrownBy(() -> one().priority(NamedColours.RED, 1).priority(NamedColours.RED, 2))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("red has priority 1 already, and not 2");
    }

    @Test
    void smallestPriority_isLowerThanNone() {
        var table = SubsumptionTable.forRobots(1)
                .when(NamedColours.BLUE, Service.SPACE_WANDERER)
                .when(NamedColours.RED, Service.SPACE_WANDERER)
                .when(NamedColours.GREEN, Service.SPACE_WANDERER)
                .priority(NamedColours.RED, Integer.MIN_VALUE)
                .build();
        var seen = List.of(TestBlobs.of(NamedColours.RED, 900, 0), TestBlobs.of(NamedColours.GREEN, 20, 40));
        assertThat(table.ruleIn(table.first()).pick(seen, 0)).hasValue(NamedColours.GREEN);
    }

    @Test
    void serviceWithTheNameOfLayers_isRefused() {
        Service avoid = new Service("avoid", false, () -> senses -> Optional.empty());
        Service other = new Service("avoid > spaceWanderer", true, SpaceWanderer::behaviour);
        var table = SubsumptionTable.forRobots(2).when(NamedColours.BLUE, avoid.over(SW), other);
        assertThatThrownBy(table::build)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageStartingWith("two different services are called avoid > spaceWanderer");
    }

    @Test
    void minusZeroSeconds_areTheSameHold() {
        var minus = one().hold(-0.0).allowFinal().build();
        var plus = one().hold(0.0).allowFinal().build();
        assertThat(minus).isEqualTo(plus).hasSameHashCodeAs(plus);
    }

    private static SubsumptionTableBuilder one() {
        return SubsumptionTable.forRobots(1).when(NamedColours.BLUE, SW);
    }
}
