package io.troupe.services.subsumption;

import static io.troupe.common.text.NamedColours.BLACK;
import static io.troupe.common.text.NamedColours.BLUE;
import static io.troupe.common.text.NamedColours.GREEN;
import static io.troupe.common.text.NamedColours.ORANGE;
import static io.troupe.common.text.NamedColours.RED;
import static io.troupe.services.behaviour.TestSenses.blob;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.services.behaviour.SpaceWanderer;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import java.util.List;
import java.util.Optional;
import org.junit.jupiter.api.Test;

class SubsumptionTableTest {
    private static final Service WF = Service.WALL_FOLLOWER;
    private static final Service SW = Service.SPACE_WANDERER;

    private final SubsumptionTable paper = SubsumptionTable.ofThePaper();

    private static SubsumptionTableBuilder robots(int count) {
        return SubsumptionTable.forRobots(count);
    }

    private static SubsumptionTableBuilder one() {
        return robots(1).state(BLUE, SW);
    }

    private static SubsumptionTableBuilder three() {
        return one().state(RED, SW).state(GREEN, SW);
    }

    @Test
    void table4_ofThePaper() {
        assertThat(paper.states()).extracting(State::number).containsExactly(1, 2, 3);
        assertThat(paper.states()).extracting(State::colour).containsExactly(BLUE, RED, GREEN);
        assertThat(paper.states())
                .extracting(State::services)
                .containsExactly(List.of(WF, SW), List.of(SW, WF), List.of(SW, SW));
        assertThat(paper.first()).isEqualTo(paper.state(BLUE).orElseThrow());
        assertThat(paper.ignored()).containsEntry(BLACK, "walls and robot 2").containsEntry(ORANGE, "robot 1");
    }

    @Test
    void blackOrangeAndTheStatesOwnColour_changeNothing() {
        State blue = paper.first();
        assertThat(paper.next(blue, BLACK)).isEmpty();
        assertThat(paper.next(blue, ORANGE)).isEmpty();
        assertThat(paper.next(blue, BLUE)).isEmpty();
        assertThat(paper.next(blue, GREEN)).map(State::number).hasValue(3);
    }

    @Test
    void stateThatNeverEnds_isRefusedWhenItCanBeReached() {
        var builder = robots(2).state(BLUE, WF, SW).state(RED, WF, WF);
        assertThatThrownBy(builder::build)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContainingAll("state 2 (red)", "allowFinal()");
        assertThat(builder.allowFinal().build().state(RED)).isPresent();
        assertThatThrownBy(robots(1).state(BLUE, WF).state(RED, WF)::build)
                .as("the first is the only one that counts")
                .hasMessageContaining("state 1 (blue) can be reached");
        var table = robots(1).allowFinal().state(BLUE, WF).build();
        assertThat(table.first().canEnd()).isFalse();
    }

    @Test
    void wrongNumbersOfServicesAndRobots_areRefused() {
        var builder = robots(2);
        assertThatThrownBy(() -> builder.state(RED, SW))
                .hasMessage("the state of red names 1 services, expected one for each of 2 robots");
        assertThatThrownBy(() -> robots(0)).hasMessageContaining("expected 1 or more");
        assertThatThrownBy(robots(1)::build).hasMessageContaining("no state");
    }

    @Test
    void ignoredAndNamedColours_areWords_andReasonsHaveNoComment() {
        assertThatThrownBy(one().ignoring(BLUE, "walls")::build)
                .hasMessage("blue leads to state 1, but the table ignores it (walls), expected one or the other");
        assertThatThrownBy(() -> one().ignoring(RED, "robot #1")).hasMessageContaining("without '#'");
        assertThatThrownBy(() -> one().ignoring(-1, "")).hasMessageContaining("expected 0x000000 to 0xFFFFFF");
        assertThatThrownBy(() -> one().colour("two words", 1)).hasMessageContaining("expected a word");
        var sky = one().colour("sky", 0xFE).ignoring(0xFE, "").build();
        assertThat(sky.colourName(0xFE)).isEqualTo("sky");
        var table = one().colour("red", 0xFE0000).ignoring(0xFE0000, "").build();
        assertThat(table.colourName(0xFE0000)).isEqualTo("red");
        assertThat(table.colourName(RED)).isEqualTo("#FF0000");
        assertThat(one().service(SW).build().services()).containsExactly(SW);
        assertThatThrownBy(one().priority(0xFE, 2)::build)
                .hasMessageStartingWith("#0000FE has priority 2 and leads to no");
    }

    @Test
    void twoServicesOfOneName_areRefused_unlessTheyAreEqual() {
        var backward = Service.wallFollower(CornerStyle.BACKWARD);
        assertThatThrownBy(robots(3).state(RED, WF, SW, backward)::build)
                .hasMessageStartingWith("two different services are called wallFollower");
        var again = Service.wallFollower(CornerStyle.FORWARD);
        assertThat(robots(3).state(RED, WF, SW, again).build().services()).containsExactly(WF, SW);
        var avoid = new Service("avoid", false, () -> senses -> Optional.empty());
        var layers = new Service("avoid > spaceWanderer", true, SpaceWanderer::behaviour);
        assertThatThrownBy(robots(2).state(BLUE, avoid.over(SW), layers)::build)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageStartingWith("two different services are called avoid > spaceWanderer");
    }

    /** A caller may look up a service for each robot at each switch. */
    @Test
    void services_areCollectedOnce_andFoundByName() {
        assertThat(paper.services()).isSameAs(paper.services()).isUnmodifiable();
        assertThat(paper.service("spaceWanderer")).containsSame(SW);
        assertThat(paper.service("none")).isEmpty();
    }

    @Test
    void layers_areOneServiceWhereverTheyAreMade() {
        Service avoid = SubsumptionTableReader.service("avoid = avoid", ServiceCatalogue.standard());
        var table = robots(2).state(RED, avoid.over(SW), avoid.over(SW)).build();
        assertThat(table.services()).containsExactly(avoid.over(SW));
    }

    @Test
    void assignments_giveEachRobotOneService() {
        assertThat(Assignment.everyRobot(SW).robot(2, WF).services(3)).containsExactly(SW, WF, SW);
        assertThatThrownBy(() -> Assignment.everyRobot(SW).others(WF)).hasMessageContaining("without an order");
        assertThatThrownBy(() -> Assignment.everyRobot(SW).robot(3, WF).services(2))
                .hasMessageContaining("expected numbers up to 2");
        assertThatThrownBy(() -> Assignment.none().robot(0, SW)).hasMessageContaining("expected numbers from 1");
    }

    @Test
    void heldState_endsEarlyForAColourOfHigherPriorityOnly() {
        var table = three().holdSeconds(2).priority(GREEN, 1).build();
        State blue = table.first();
        assertThat(table.next(blue, RED, 1.9)).isEmpty();
        assertThat(table.next(blue, RED, 2)).map(State::colour).hasValue(RED);
        assertThat(table.next(blue, GREEN, 0)).map(State::colour).hasValue(GREEN);
        assertThat(table.next(table.state(GREEN).orElseThrow(), RED, 1)).isEmpty();
        var both = List.of(blob(RED, 500, 0), blob(GREEN, 20, 0), blob(BLACK, 900, 0));
        assertThat(table.ruleIn(blue).pick(both, 5)).hasValue(GREEN);
        assertThat(table.ruleIn(blue).pick(both.subList(0, 1), 1)).isEmpty();
        assertThatThrownBy(() -> robots(1).holdSeconds(Double.NaN)).hasMessageContaining("expected 0 or more");
        var minus = one().holdSeconds(-0.0).allowFinal().build();
        var plus = one().holdSeconds(0.0).allowFinal().build();
        assertThat(minus).isEqualTo(plus).hasSameHashCodeAs(plus);
    }

    @Test
    void smallestPriority_isLowerThanNone_andASecondOneOfAColourIsRefused() {
        var table = three().priority(RED, Integer.MIN_VALUE).build();
        var seen = List.of(blob(RED, 900, 0), blob(GREEN, 20, 40));
        assertThat(table.ruleIn(table.first()).pick(seen, 0)).hasValue(GREEN);
        assertThatThrownBy(() -> one().priority(RED, 1).priority(RED, 2))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("red has priority 1 already, and not 2");
    }
}
