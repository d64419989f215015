package io.troupe.petri.wiring;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.RobotTeams;
import io.troupe.petri.SearchEnd;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.wiring.WiringResult.Deadlock;
import io.troupe.petri.wiring.WiringResult.DeadlockFree;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** The paper's components for several robots with a player each, which share one middleware and one service. */
class RobotTeamWiringTest {
    private static final SearchLimits SMALL = SearchLimits.markings(100_000);

    @Test
    void nets_ofTwoRobots_areThoseOfTheTeamsUpToNames() {
        var wiring = PaperWiring.robots(2);

        assertThat(Isomorphism.find(wiring.net(), RobotTeams.uncorrected(2))).isPresent();
        assertThat(Isomorphism.find(wiring.withSynchronisedStop().net(), RobotTeams.stoppingTogether(2)))
                .isPresent();
        assertThat(Isomorphism.find(PaperWiring.robotsStoppingOneByOne(2).net(), RobotTeams.stoppingOneByOne(2)))
                .hasValueSatisfying(names ->
                        assertThat(names.get("robot1 and player1 stop")).startsWith("Tstop."));
    }

    @ParameterizedTest
    @CsvSource({"1, 6, 14", "2, 18, 22", "3, 54, 30", "4, 162, 38", "5, 486, 46", "6, 1458, 54"})
    void robots_thatStopWhenTheyLike_haveAllDeadMarkingsAndAStory(int robots, int dead, int firings) {
        var wiring = PaperWiring.robots(robots);

        var result = (Deadlock) WiringCheck.check(wiring, SMALL);

        assertThat(result.reduced().end()).isEqualTo(SearchEnd.COMPLETE);
        assertThat(result.reduced().deadMarkings()).isEqualTo(dead);
        assertThat(result.story().sentence())
                .isEqualTo(
                        robots == 1
                                ? "player1 stops; robot1 waits for player1.setValues, which nobody will answer"
                                : "player1 stops; robot1 waits for player1.setValues, which nobody will answer");
        assertThat(result.story().firings()).hasSize(firings);
        var net = wiring.net();
        var end = net.fire(
                net.initialMarking(),
                result.story().firings().stream().map(net::transition).toList());
        assertThat(net.enabled(end)).isEmpty();
        assertThat(result.repair().orElseThrow().isDeadlockFree()).isTrue();
    }

    /** The correct wiring of six robots: all stop together. */
    @Test
    void sixRobots_thatStopTogether_areProvedToHaveNoDeadMarking() {
        var result = WiringCheck.check(PaperWiring.robots(6).withSynchronisedStop(), SMALL);

        assertThat(result).isInstanceOf(DeadlockFree.class);
        assertThat(result.reduced().isComplete()).isTrue();
        assertThat(result.reduced().deadMarkings()).isZero();
        assertThat(result.figures().end()).isEqualTo(SearchEnd.LIMIT);
        assertThat(result.toString()).contains("never all wait for ever", "not known whether one can while others");
    }
}
