package io.troupe.petri.wiring;

import static io.troupe.petri.wiring.Protocol.does;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

import io.troupe.petri.RobotTeams;
import io.troupe.petri.SearchEnd;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.wiring.WiringResult.Blocked;
import io.troupe.petri.wiring.WiringResult.Deadlock;
import io.troupe.petri.wiring.WiringResult.DeadlockFree;
import io.troupe.petri.wiring.WiringResult.Proved;
import io.troupe.petri.wiring.WiringResult.Unknown;
import java.util.List;
import java.util.Set;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicInteger;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

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
    void robots_thatStopWhenTheyLike_haveAllDeadMarkingsAndACounterexample(int robots, int dead, int firings) {
        var wiring = PaperWiring.robots(robots);

        var result = (Deadlock) WiringCheck.check(wiring, SMALL);

        assertThat(result.reduced().end()).isEqualTo(SearchEnd.COMPLETE);
        assertThat(result.reduced().deadMarkings()).isEqualTo(dead);
        assertThat(result.counterexample().sentence())
                .isEqualTo("player1 stops; robot1 waits for player1.setValues, which nobody will answer");
        assertThat(result.counterexample().firings()).hasSize(firings);
        var net = wiring.net();
        var end = net.fire(
                net.initialMarking(),
                result.counterexample().firings().stream().map(net::transition).toList());
        assertThat(net.enabled(end)).isEmpty();
        assertThat(result.repair().orElseThrow().isProved()).isTrue();
    }

    /** The correct wiring of six robots: all stop together. */
    @Test
    void sixRobots_thatStopTogether_areProved() {
        var wiring = PaperWiring.robots(6).withSynchronisedStop();

        var result = WiringCheck.check(wiring, SMALL);

        assertThat(result).isInstanceOf(Proved.class);
        assertThat(result.reduced().isComplete()).isTrue();
        assertThat(result.reduced().deadMarkings()).isZero();
        assertThat(result.figures().end()).isEqualTo(SearchEnd.LIMIT);
        assertThat(result.toString()).contains("proved free of deadlock", "stopped at this limit", "by stubborn sets");
        assertThat(wiring.net().transitions())
                .filteredOn(transition -> transition.name().startsWith("all stop"))
                .hasSize(1);
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 3, 6})
    void robots_thatStopWithTheirPlayerEach_areProved(int robots) {
        assertThat(WiringCheck.check(PaperWiring.robotsStoppingOneByOne(robots), SMALL))
                .isInstanceOf(Proved.class);
    }

    @Test
    void pairs_thatAreAlike_areSearchedOnceAndToldByTheirOwnNames() {
        var check = new WiringCheck.PairCheck(PaperWiring.robots(6), SMALL);

        var results = check.results();

        assertThat(results).hasSize(13);
        assertThat(check.searched()).isEqualTo(3);
        var last = results.stream().filter(pair -> pair.one().equals("robot6")).toList();
        assertThat(last).singleElement().satisfies(pair -> {
            assertThat(pair.counterexamples()).singleElement().satisfies(counterexample -> {
                assertThat(counterexample.sentence())
                        .isEqualTo("player6 stops; robot6 waits for player6.setValues, which nobody will answer");
                assertThat(counterexample.firings()).hasSize(8).allMatch(step -> step.contains("6"));
                assertThat(counterexample.circle()).extracting(Wait::component).containsExactly("robot6", "player6");
            });
            assertThat(pair.figures().neverReached()).isEmpty();
        });
    }

    /** An independent clock makes the full graph larger, but neither the graph of the search nor the block. */
    @Test
    void block_beyondTheFullGraph_isToldWithAWay() {
        var clock = Protocol.of("clock")
                .in("tick", does("tick").then("tock"))
                .in("tock", does("tock").then("tick"))
                .build();
        var wiring = Wiring.of("blocked").components("clock", 2, clock);
        for (var i = 1; i <= 4; i++) {
            wiring.component("robot" + i, PaperWiring.robot())
                    .component("player" + i, PaperWiring.player())
                    .bind("robot" + i, "player", "player" + i);
        }
        var whole = wiring.component(PaperWiring.middleware())
                .component(PaperWiring.service())
                .build();

        var result = (Blocked) WiringCheck.check(whole, SMALL);

        assertThat(result.figures().isComplete()).isFalse();
        assertThat(result.reduced().showsBlocks()).isTrue();
        var counterexample = result.counterexample();
        assertThat(counterexample.isShortest()).isFalse();
        assertThat(counterexample.toString()).contains("steps, perhaps not the fewest");
        assertThat(counterexample.waits())
                .hasSize(10)
                .noneMatch(wait -> wait.component().startsWith("clock"));
        var net = whole.net();
        var end = net.fire(
                net.initialMarking(),
                counterexample.firings().stream().map(net::transition).toList());
        assertThat(net.enabled(end)).allMatch(transition -> transition.name().startsWith("clock"));
        assertThat(result.repair().orElseThrow().isDeadlockFree()).isTrue();
    }

    @Test
    void limits_thatEndBothSearches_leaveItUnknown() {
        var result = WiringCheck.check(PaperWiring.robots(6), 50);

        assertThat(result).isInstanceOf(Unknown.class);
        assertThat(result.reduced().end()).isEqualTo(SearchEnd.LIMIT);
        assertThat(result.figures().markings()).isEqualTo(50);
        assertThat(result.toString()).contains("not known", "50 markings (stopped at this limit)");
    }

    @Test
    void check_reportsAndCanBeCancelled() {
        var stop = new AtomicBoolean();
        var heard = new AtomicInteger();
        var limits = SMALL.cancelledBy(stop::get).reporting(50, progress -> {
            heard.incrementAndGet();
            stop.set(true);
        });

        var result = WiringCheck.check(PaperWiring.robots(6), limits);

        assertThat(heard).hasValue(1);
        assertThat(result).isInstanceOf(Unknown.class);
        assertThat(result.reduced().end()).isEqualTo(SearchEnd.CANCELLED);
        assertThat(result.figures().end()).isEqualTo(SearchEnd.CANCELLED);
        assertThat(result.toString()).contains("(cancelled)");
    }

    /** The limit is too low for the second search by stubborn sets, which enlarges loops, but enough for the first. */
    @Test
    void noDeadMarking_withoutAWordOnBlocks_isNotCalledProved() {
        var ticking = Protocol.of("clock")
                .in("one", does("one").then("two"))
                .in("two", does("two").then("three"))
                .in("three", does("three").then("one"))
                .build();
        var wiring = Wiring.of("clocks").components("clock", 8, ticking).build();

        var result = WiringCheck.check(wiring, 100);

        assertThat(result).isInstanceOf(DeadlockFree.class);
        assertThat(result.reduced()).isEqualTo(new ReducedFigures(3, 3, 0, SearchEnd.COMPLETE, false));
        assertThat(result.toString()).contains("never all wait for ever", "not known whether one can");
    }

    @Test
    void groups_thatMakeNoSense_areRefused() {
        var wiring = PaperWiring.robots(2);

        assertThatIllegalArgumentException()
                .isThrownBy(() -> wiring.withSynchronisedStops(List.of(Set.of("robot1", "player1"), Set.of("robot1"))))
                .withMessageContaining("robot1 stops in two groups");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> wiring.withSynchronisedStops(List.of(Set.of("robot3"))))
                .withMessageContaining("there is no component robot3");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> wiring.withSynchronisedStops(List.of(Set.of("robot1", "player1"))))
                .withMessage(
                        "wiring 2 robots: robot2 is in no group that stops, but can do nothing else in state leaving");
        var clock = Protocol.of("clock").in("on", does("tick").then("on")).build();
        assertThatIllegalArgumentException()
                .isThrownBy(
                        () -> Wiring.of("w").component(clock).build().withSynchronisedStops(List.of(Set.of("clock"))))
                .withMessage("wiring w: nobody stops in group [clock]; expected a component that declares a stop");
    }
}
