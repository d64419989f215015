package io.troupe.petri;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

import io.troupe.petri.PaperNets.Reading;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class RobotTeamsTest {
    private static PetriNet net(String design, int robots) {
        return switch (design) {
            case "uncorrected" -> RobotTeams.uncorrected(robots);
            case "together" -> RobotTeams.stoppingTogether(robots);
            case "oneByOne" -> RobotTeams.stoppingOneByOne(robots);
            default -> throw new IllegalArgumentException(design);
        };
    }

    @Test
    void teamOfOne_isThePapersNet() {
        assertThat(RobotTeams.uncorrected(1)
                        .renamed("one", name -> name.replace(".1", ""))
                        .structure())
                .isEqualTo(PaperNets.uncorrected(Reading.A).structure());
        assertThat(RobotTeams.stoppingTogether(1)
                        .renamed("one", name -> name.replace(".1", ""))
                        .structure())
                .isEqualTo(PaperNets.corrected(Reading.A).structure());
    }

    @ParameterizedTest
    @CsvSource({
        "uncorrected, 1,   1264,  6, NO,  NO",
        "uncorrected, 2, 49_536, 18, NO,  NO",
        "together,    1,    429,  0, YES, YES",
        "together,    2, 11_653,  0, YES, YES",
        "together,    3, 283_741, 0, YES, YES",
        "oneByOne,    1,    504,  0, NO,  NO",
        "oneByOne,    2, 12_028,  0, NO,  NO",
        "oneByOne,    3, 285_616, 0, NO,  NO"
    })
    void team_hasTheKnownNumbers(
            String design, int robots, String markings, int dead, Verdict live, Verdict reversible) {
        var graph = ReachabilityGraph.explore(net(design, robots));
        var liveness = Liveness.of(graph);

        assertThat(graph.isComplete()).isTrue();
        assertThat(graph.size()).isEqualTo(Integer.parseInt(markings.replace("_", "")));
        assertThat(graph.dead()).hasSize(dead);
        assertThat(graph.safe()).isEqualTo(Verdict.YES);
        assertThat(liveness.live()).isEqualTo(live);
        assertThat(liveness.reversible()).isEqualTo(reversible);
        assertThat(liveness.terminalComponents()).hasSize(Math.max(dead, 1));
    }

    /** Takes some seconds and 200 MiB: two million markings, eleven million edges. */
    @Test
    @Tag("slow")
    void threeUncorrectedRobots_haveTheKnownNumbers() {
        var graph = ReachabilityGraph.explore(RobotTeams.uncorrected(3));

        assertThat(graph.isComplete()).isTrue();
        assertThat(graph.size()).isEqualTo(1_928_448);
        assertThat(graph.dead()).hasSize(54);
        assertThat(Liveness.of(graph).terminalComponents()).hasSize(54).allMatch(TerminalComponent::isDead);
    }

    /** The middleware and the service never stop, so only what happens once at their start is not live. */
    @Test
    void robotsStoppingOneByOne_loseTheRegistrationOnly() {
        var liveness = Liveness.of(ReachabilityGraph.explore(RobotTeams.stoppingOneByOne(2)));

        assertThat(liveness.terminalComponents())
                .singleElement()
                .satisfies(component -> assertThat(component.neverFired())
                        .isEqualTo(liveness.notLive())
                        .extracting(Transition::name)
                        .containsExactlyInAnyOrder("Tm1", "Ts1''", "Tms1''", "Tms2''"));
    }

    @ParameterizedTest
    @CsvSource({
        "uncorrected, 1, 6", "uncorrected, 2, 18", "uncorrected, 3, 54", "uncorrected, 4, 162", "uncorrected, 5, 486",
        "uncorrected, 6, 1458", "together, 1, 0", "together, 2, 0", "together, 3, 0", "together, 4, 0",
        "together, 5, 0", "together, 6, 0", "oneByOne, 1, 0", "oneByOne, 2, 0", "oneByOne, 3, 0",
        "oneByOne, 4, 0", "oneByOne, 5, 0", "oneByOne, 6, 0"
    })
    void deadlockSearch_ofTeam_findsAllDeadMarkings(String design, int robots, int dead) {
        var net = net(design, robots);

        var search = DeadlockSearch.run(net, SearchLimits.markings(100_000));

        assertThat(search.end()).isEqualTo(SearchEnd.COMPLETE);
        assertThat(search.deadlocks()).hasSize(dead).doesNotHaveDuplicates();
        assertThat(search.deadlockFree()).isEqualTo(dead == 0 ? Verdict.YES : Verdict.NO);
        for (var deadlock : search.deadlocks()) {
            assertThat(net.fire(net.initialMarking(), deadlock.trace())).isEqualTo(deadlock.marking());
            assertThat(net.enabled(deadlock.marking())).isEmpty();
        }
    }

    @Test
    void team_withoutRobots_isRefused() {
        assertThatIllegalArgumentException()
                .isThrownBy(() -> RobotTeams.stoppingOneByOne(0))
                .withMessage("robots is 0, expected 1 or more");
    }
}
