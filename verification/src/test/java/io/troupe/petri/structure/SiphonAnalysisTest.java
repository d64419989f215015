package io.troupe.petri.structure;

import static io.troupe.petri.PaperNets.Reading.A;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;
import static org.assertj.core.api.Assertions.within;
import static org.assertj.core.api.InstanceOfAssertFactories.type;

import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.PetriNet;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.Verdict;
import io.troupe.petri.structure.SiphonVerdict.Emptied;
import io.troupe.petri.structure.SiphonVerdict.HoldsMarkedTrap;
import io.troupe.petri.structure.SiphonVerdict.HoldsTokens;
import io.troupe.petri.structure.SiphonVerdict.MayBeEmptied;
import io.troupe.petri.structure.SiphonVerdict.NeverEmpty;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class SiphonAnalysisTest {
    @ParameterizedTest
    @CsvSource({"A, false, 44, 20", "A, true, 48, 0", "B, false, 36, 12", "B, true, 48, 0"})
    void paperNet_trapsStateEquationAndReachabilityAgreeOnEverySiphon(
            Reading reading, boolean corrected, int count, int emptiable) {
        var net = Nets.paper(reading, corrected);
        var graph = ReachabilityGraph.explore(net);
        var equation = new StateEquation(net);

        var analysis = SiphonAnalysis.of(net);

        assertThat(analysis.verdicts()).hasSize(count);
        assertThat(analysis.verdicts().stream().filter(MayBeEmptied.class::isInstance))
                .hasSize(emptiable);
        assertThat(analysis.verdicts().stream().filter(HoldsMarkedTrap.class::isInstance))
                .hasSize(count - emptiable);
        assertThat(analysis.verdicts()).allSatisfy(verdict -> {
            var siphon = verdict.siphon();
            var candidate = verdict instanceof MayBeEmptied;
            assertThat(SiphonAnalysis.confirm(siphon, graph))
                    .isInstanceOf(candidate ? Emptied.class : NeverEmpty.class);
            assertThat(equation.leastTokens(siphon).orElseThrow()).isCloseTo(candidate ? 0 : 1, within(1e-9));
            var bound = equation.lowerBound(siphon);
            assertThat(bound.isPresent()).isEqualTo(!candidate);
            bound.ifPresent(proved -> assertThat(proved.tokens()).isEqualTo(1));
        });
        if (corrected) {
            assertThat(analysis.deadlock())
                    .asInstanceOf(type(DeadlockVerdict.NoDeadMarking.class))
                    .satisfies(proved -> {
                        assertThat(proved.proofs()).hasSize(count);
                        assertThat(proved.isByTrapsAlone()).isTrue();
                    });
            assertThat(graph.deadlockFree()).isEqualTo(Verdict.YES);
        } else {
            assertThat(analysis.deadlock())
                    .asInstanceOf(type(DeadlockVerdict.Candidates.class))
                    .satisfies(candidates -> assertThat(candidates.siphons()).hasSize(emptiable));
            assertThat(graph.deadlockFree()).isEqualTo(Verdict.NO);
        }
    }

    @ParameterizedTest
    @CsvSource({"false, uncorrected-siphons.json", "true, corrected-siphons.json"})
    void paperNet_ofReadingA_hasTheCandidatesThatOtherToolsFound(boolean corrected, String file) {
        var candidates = SiphonAnalysis.of(Nets.paper(A, corrected)).verdicts().stream()
                .filter(MayBeEmptied.class::isInstance)
                .map(SiphonVerdict::siphon)
                .toList();

        assertThat(SetLists.names(candidates)).isEqualTo(SetLists.read(file, "emptiable"));
    }

    @ParameterizedTest
    @CsvSource({
        "robot,              '',      0",
        "player,             '',      0",
        "middleware,         '',      0",
        "service,            '',      0",
        "robot player,       Tr2,     0",
        "robot player,       Tr2 Tr4, 1",
        "player middleware,  Tp3,     0",
        "middleware service, Tm2,     0",
        "middleware service, Ts1,     0",
        "middleware service, Ts1 Tm2, 2"
    })
    void part_isProvedDeadlockFreeExactlyWhenItIs(String components, String requests, int dead) {
        var net = Nets.part(components, requests);

        var graph = ReachabilityGraph.explore(net);
        var analysis = SiphonAnalysis.of(net);

        assertThat(graph.dead()).hasSize(dead);
        assertThat(analysis.deadlock())
                .isInstanceOf(dead == 0 ? DeadlockVerdict.NoDeadMarking.class : DeadlockVerdict.Candidates.class);
        assertThat(analysis.verdicts())
                .allSatisfy(verdict -> assertThat(SiphonAnalysis.confirm(verdict.siphon(), graph))
                        .isInstanceOf(verdict instanceof MayBeEmptied ? Emptied.class : NeverEmpty.class));
    }

    /** Siphons ignore priorities, so the answer stays "not decided" although no marking is dead. */
    @Test
    void stopsOfLowerPriority_stillHaveTwentyCandidates() {
        var net = PaperNets.lowPriorityStops(A);

        assertThat(SiphonAnalysis.of(net).deadlock())
                .asInstanceOf(type(DeadlockVerdict.Candidates.class))
                .satisfies(candidates -> assertThat(candidates.siphons()).hasSize(20));
        assertThat(ReachabilityGraph.explore(net).deadlockFree()).isEqualTo(Verdict.YES);
    }

    @Test
    void confirm_emptiedSiphon_showsTheNearestMarkingAndItsTrace() {
        var net = PaperNets.uncorrected(A);
        var siphon = PlaceSet.of(net, "M1", "M4", "M9''", "S3''", "S4", "S7", "S8", "S9", "S10");

        var verdict = SiphonAnalysis.confirm(siphon, ReachabilityGraph.explore(net));

        assertThat(verdict).asInstanceOf(type(Emptied.class)).satisfies(emptied -> {
            var after = net.fire(net.initialMarking(), emptied.state().shortestTrace());
            assertThat(siphon.tokens(after)).isZero();
        });
    }

    @Test
    void confirm_inAPartOfTheGraph_staysACandidate() {
        var net = PaperNets.corrected(A);
        var siphon = Siphons.minimalSiphons(net).sets().get(0);

        assertThat(SiphonAnalysis.confirm(siphon, ReachabilityGraph.explore(net, 10)))
                .isInstanceOf(MayBeEmptied.class);
        assertThatIllegalArgumentException()
                .isThrownBy(() -> SiphonAnalysis.confirm(PlaceSet.of(net, "R5"), ReachabilityGraph.explore(net, 10)))
                .withMessage("{R5} is not a siphon of net corrected A");
    }

    @Test
    void deadlock_withoutAllSiphons_isNotDecided() {
        var analysis = SiphonAnalysis.of(PaperNets.corrected(A), 5);

        assertThat(analysis.verdicts()).isNotEmpty();
        assertThat(analysis.deadlock())
                .asInstanceOf(type(DeadlockVerdict.Undecided.class))
                .satisfies(undecided -> assertThat(undecided.reason())
                        .startsWith("net corrected A: none of the ")
                        .endsWith("the search stopped at its limit, or was cancelled"));
    }

    /** The siphon keeps its only token, and the marking is dead nevertheless. */
    @Test
    void deadlock_withAnInputWeight_isNotDecided() {
        var net = PetriNet.builder("pairs")
                .place("a", 1)
                .transition("t")
                .arc("a", "t", 2)
                .arc("t", "a", 2)
                .build();

        var analysis = SiphonAnalysis.of(net);

        assertThat(analysis.verdicts()).singleElement().isInstanceOf(HoldsMarkedTrap.class);
        assertThat(analysis.deadlock())
                .isEqualTo(new DeadlockVerdict.Undecided(
                        "net pairs: the arc a -> t has weight 2, so a dead marking need not have an empty siphon"));
        assertThat(ReachabilityGraph.explore(net).deadlockFree()).isEqualTo(Verdict.NO);
    }

    @Test
    void deadlock_withoutTransitions_isNotExcluded() {
        var net = PetriNet.builder("still").place("a", 1).build();

        assertThat(SiphonAnalysis.of(net).deadlock())
                .isEqualTo(new DeadlockVerdict.Undecided("net still has no transitions: its only marking is dead"));
    }

    /** c lets only one of the three tokens of a go, but there is no trap: only the state equation proves it. */
    @Test
    void judge_siphonWithoutMarkedTrap_isProvedByTheStateEquation() {
        var net = PetriNet.builder("weights")
                .place("a", 3)
                .place("b")
                .place("c", 1)
                .place("d")
                .transition("t", List.of("a", "c"), List.of("d"))
                .build();
        var siphon = PlaceSet.of(net, "a");

        var verdict = SiphonAnalysis.judge(siphon);

        assertThat(verdict).asInstanceOf(type(HoldsTokens.class)).satisfies(proved -> {
            assertThat(proved.bound().tokens()).isEqualTo(2);
            assertThat(proved.siphon()).isEqualTo(siphon);
        });
        assertThat(new StateEquation(net).leastTokens(siphon).orElseThrow()).isCloseTo(2, within(1e-9));
        assertThatIllegalArgumentException()
                .isThrownBy(() -> SiphonAnalysis.judge(PlaceSet.of(net, "d")))
                .withMessage("{d} is not a siphon of net weights");
    }

    /** The constructor of a proof checks it. */
    @Test
    void proofs_thatProveNothing_areRefused() {
        var net = PaperNets.player();
        var p1 = PlaceSet.of(net, "P1");
        var all = PlaceSet.of(net, net.places());

        assertThatIllegalArgumentException()
                .isThrownBy(() -> new HoldsMarkedTrap(all, p1))
                .withMessage("{P1} is not a trap in {P1, P4, P7}");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> new TokenBound(p1, Map.of(net.place("P1"), 1L), 1))
                .withMessage("transition Tp1 changes the weighted sum by -1, expected 0 or more");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> new TokenBound(p1, Map.of(net.place("P4"), 1L), 1))
                .withMessage("place P4 weighs 1, expected 0 or less for a bound on {P1}");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> new HoldsTokens(new TokenBound(all, Map.of(), 1)))
                .withMessageContaining("expected 1 or more");
        var initial = ReachabilityGraph.explore(net).states().get(0);
        assertThatIllegalArgumentException().isThrownBy(() -> new Emptied(all, initial));
        assertThat(Stream.of(1L, 2L)
                        .map(scale -> new TokenBound(
                                        all,
                                        Map.of(net.place("P1"), scale, net.place("P4"), scale, net.place("P7"), scale),
                                        scale)
                                .tokens()))
                .containsExactly(1L, 1L);
    }
}
