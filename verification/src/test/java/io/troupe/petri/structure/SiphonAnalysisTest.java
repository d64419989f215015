package io.troupe.petri.structure;

import static io.troupe.petri.Nets.net;
import static io.troupe.petri.Nets.refused;
import static io.troupe.petri.PaperNets.Reading.A;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;
import static org.assertj.core.api.Assertions.within;

import io.troupe.petri.Nets;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.PetriNet;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.Verdict;
import io.troupe.petri.structure.DeadlockVerdict.Candidates;
import io.troupe.petri.structure.DeadlockVerdict.NoDeadMarking;
import io.troupe.petri.structure.DeadlockVerdict.Undecided;
import io.troupe.petri.structure.EmptySiphonVerdict.NoneCanBeEmptied;
import io.troupe.petri.structure.SiphonVerdict.CannotBeEmptied;
import io.troupe.petri.structure.SiphonVerdict.Emptied;
import io.troupe.petri.structure.SiphonVerdict.HoldsMarkedTrap;
import io.troupe.petri.structure.SiphonVerdict.HoldsTokens;
import io.troupe.petri.structure.SiphonVerdict.MayBeEmptied;
import io.troupe.petri.structure.SiphonVerdict.NeverEmpty;
import io.troupe.tools.Thorough;
import java.time.Duration;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.concurrent.atomic.AtomicInteger;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** The verdicts on single siphons, and the program that asks for an empty one. */
class SiphonAnalysisTest {
    private static final Duration LIMIT = Duration.ofSeconds(60);
    private static final PetriNet PAIRS = net("pairs", "a=1", "t: 2*a > 2*a");

    @ParameterizedTest
    @CsvSource({"A, false, 44, 20", "A, true, 48, 0", "B, false, 36, 12", "B, true, 48, 0"})
    void paperNet_trapsStateEquationProgramAndReachabilityAgreeOnEverySiphon(
            Reading reading, boolean corrected, int count, int emptiable) {
        var net = Nets.paper(reading, corrected);
        var graph = ReachabilityGraph.explore(net);
        var equation = new StateEquation(net);

        var analysis = SiphonAnalysis.of(net);
        var program = EmptySiphonProgram.solve(net, LIMIT);

        assertThat(analysis.verdicts())
                .filteredOn(MayBeEmptied.class::isInstance)
                .hasSize(emptiable);
        assertThat(analysis.verdicts()).hasSize(count).allSatisfy(verdict -> {
            var siphon = verdict.siphon();
            var candidate = verdict instanceof MayBeEmptied;
            assertThat(verdict).isInstanceOfAny(MayBeEmptied.class, HoldsMarkedTrap.class);
            assertThat(SiphonAnalysis.confirm(siphon, graph))
                    .isInstanceOf(candidate ? Emptied.class : NeverEmpty.class);
            assertThat(equation.leastTokens(siphon).orElseThrow()).isCloseTo(candidate ? 0 : 1, within(1e-9));
            var bound = equation.lowerBound(siphon).map(TokenBound::tokens);
            assertThat(bound).isEqualTo(candidate ? Optional.empty() : Optional.of(1L));
        });
        assertThat(graph.deadlockFree()).isEqualTo(corrected ? Verdict.YES : Verdict.NO);
        if (corrected) {
            var proved = (NoDeadMarking) analysis.deadlock();
            assertThat(proved.proofs()).hasSize(count);
            assertThat(proved.isByTrapsAlone()).isTrue();
            assertThat(program).isEqualTo(new NoneCanBeEmptied(true));
        } else {
            var candidates = ((Candidates) analysis.deadlock()).siphons();
            assertThat(candidates).hasSize(emptiable);
            assertThat(candidates)
                    .extracting(SiphonVerdict::siphon)
                    .contains(((EmptySiphonVerdict.MayBeEmptied) program).siphon());
        }
    }

    /** With the cutting planes of ojAlgo 56.1.1, robot and player with both calls had no solution, which is wrong. */
    @ParameterizedTest
    @CsvSource({
        "robot,              '',       1, 0",
        "player,             '',       1, 0",
        "middleware,         '',       1, 0",
        "service,            '',       1, 0",
        "robot player,       Tr2,      4, 0",
        "robot player,       Tr2 Tr4, 12, 1",
        "player middleware,  Tp3,      4, 0",
        "middleware service, Tm2,      4, 0",
        "middleware service, Ts1,      4, 0",
        "middleware service, Ts1 Tm2, 16, 2"
    })
    void part_isProvedDeadlockFreeExactlyWhenItIs(String components, String requests, int siphons, int dead) {
        var net = Nets.part(components, requests);
        var graph = ReachabilityGraph.explore(net);
        var analysis = SiphonAnalysis.of(net);
        var program = EmptySiphonProgram.solve(net, LIMIT);
        assertThat(graph.dead()).hasSize(dead);
        assertThat(analysis.deadlock()).isInstanceOf(dead == 0 ? NoDeadMarking.class : Candidates.class);
        assertThat(program).isInstanceOf(dead == 0 ? NoneCanBeEmptied.class : EmptySiphonVerdict.MayBeEmptied.class);
        assertThat(analysis.verdicts())
                .hasSize(siphons)
                .allSatisfy(verdict -> assertThat(SiphonAnalysis.confirm(verdict.siphon(), graph))
                        .isInstanceOf(verdict instanceof MayBeEmptied ? Emptied.class : NeverEmpty.class));
    }

    /** Siphons ignore priorities, so the answer stays "not decided" although no marking is dead. */
    @Test
    void stopsOfLowerPriority_stillHaveTwentyCandidates() {
        var net = PaperNets.lowPriorityStops(A);
        assertThat(((Candidates) SiphonAnalysis.of(net).deadlock()).siphons()).hasSize(20);
        assertThat(ReachabilityGraph.explore(net).deadlockFree()).isEqualTo(Verdict.YES);
    }

    @Test
    void confirm_emptiedSiphon_showsTheNearestMarkingAndItsTrace() {
        var net = PaperNets.uncorrected(A);
        var siphon = PlaceSet.of(net, "M1", "M4", "M9''", "S3''", "S4", "S7", "S8", "S9", "S10");
        var emptied = (Emptied) SiphonAnalysis.confirm(siphon, ReachabilityGraph.explore(net));
        var after = net.fire(net.initialMarking(), emptied.state().shortestTrace());
        assertThat(siphon.tokens(after)).isZero();
    }

    @Test
    void confirm_inAPartOfTheGraph_staysACandidate() {
        var net = PaperNets.corrected(A);
        var siphon = Siphons.minimalSiphons(net).sets().get(0);
        var part = ReachabilityGraph.explore(net, 10);
        assertThat(SiphonAnalysis.confirm(siphon, part)).isInstanceOf(MayBeEmptied.class);
        refused(() -> SiphonAnalysis.confirm(PlaceSet.of(net, "R5"), part), "{R5} is not a siphon of net corrected A");
    }

    @Test
    void deadlock_withoutAllSiphons_isNotDecided() {
        var analysis = SiphonAnalysis.of(PaperNets.corrected(A), 5);
        assertThat(analysis.verdicts()).isNotEmpty();
        assertThat(((Undecided) analysis.deadlock()).reason())
                .startsWith("net corrected A: none of the ")
                .endsWith("the search stopped at its limit, or was cancelled");
    }

    @Test
    void analysis_withoutTime_decidesNothing() {
        var net = PaperNets.corrected(A);
        var asked = new AtomicInteger();
        var found = SiphonAnalysis.of(
                net, Siphons.DEFAULT_MAX_STEPS, () -> Duration.ofHours(asked.incrementAndGet() > 2_000 ? 0 : 1));
        assertThat(found.siphons().isComplete()).isFalse();
        assertThat(found.verdicts()).hasSameSizeAs(found.siphons().sets()).allMatch(MayBeEmptied.class::isInstance);
        assertThat(found.deadlock()).isNotInstanceOf(NoDeadMarking.class);
        var none = SiphonAnalysis.of(net, 1, () -> Duration.ZERO);
        assertThat(none.deadlock()).isInstanceOf(Undecided.class);
        var all = SiphonAnalysis.of(net, Siphons.DEFAULT_MAX_STEPS, () -> Duration.ofHours(1));
        assertThat(all.deadlock()).isInstanceOf(NoDeadMarking.class);
    }

    /** The siphon keeps its only token, and the marking is dead nevertheless. */
    @Test
    void inputWeight_leavesDeadMarkingsOpen() {
        var analysis = SiphonAnalysis.of(PAIRS);
        assertThat(analysis.verdicts()).singleElement().isInstanceOf(HoldsMarkedTrap.class);
        assertThat(analysis.deadlock())
                .isEqualTo(new Undecided(
                        "net pairs: the arc a -> t has weight 2, so a dead marking need not have an empty siphon"));
        assertThat(ReachabilityGraph.explore(PAIRS).deadlockFree()).isEqualTo(Verdict.NO);
        assertThat(EmptySiphonProgram.solve(PAIRS, LIMIT)).isEqualTo(new NoneCanBeEmptied(false));
    }

    @Test
    void deadlock_withoutTransitions_isNotExcluded() {
        assertThat(SiphonAnalysis.of(net("still", "a=1")).deadlock())
                .isEqualTo(new Undecided("net still has no transitions: its only marking is dead"));
    }

    /** c lets only one of the three tokens of a go, but there is no trap: only the state equation proves it. */
    @Test
    void judge_siphonWithoutMarkedTrap_isProvedByTheStateEquation() {
        var net = net("weights", "a=3 b c=1 d", "t: a c > d");
        var siphon = PlaceSet.of(net, "a");
        var proved = (HoldsTokens) SiphonAnalysis.judge(siphon);
        assertThat(proved.bound().tokens()).isEqualTo(2);
        assertThat(proved.siphon()).isEqualTo(siphon);
        assertThat(new StateEquation(net).leastTokens(siphon).orElseThrow()).isCloseTo(2, within(1e-9));
        refused(() -> SiphonAnalysis.judge(PlaceSet.of(net, "d")), "{d} is not a siphon of net weights");
    }

    /** The constructor of a proof checks it. */
    @Test
    void proofs_thatProveNothing_areRefused() {
        var net = PaperNets.player();
        var p1 = PlaceSet.of(net, "P1");
        var all = PlaceSet.of(net, net.places());

        refused(() -> new HoldsMarkedTrap(all, p1), "{P1} is not a trap in {P1, P4, P7}");
        refused(
                () -> new TokenBound(p1, Map.of(net.place("P1"), 1L), 1),
                "transition Tp1 changes the weighted sum by -1, expected 0 or more");
        refused(
                () -> new TokenBound(p1, Map.of(net.place("P4"), 1L), 1),
                "place P4 weighs 1, expected 0 or less for a bound on {P1}");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> new HoldsTokens(new TokenBound(all, Map.of(), 1)))
                .withMessageContaining("expected 1 or more");
        var initial = ReachabilityGraph.explore(net).states().get(0);
        assertThatIllegalArgumentException().isThrownBy(() -> new Emptied(all, initial));
        for (var scale : List.of(1L, 2L)) {
            var weights = Map.of(net.place("P1"), scale, net.place("P4"), scale, net.place("P7"), scale);
            assertThat(new TokenBound(all, weights, scale).tokens()).isEqualTo(1);
        }
    }

    @Test
    void programOfAPlaceWithoutBound_isNotDecided() {
        assertThat(EmptySiphonProgram.solve(net("growing", "a=1 heap", "more: a > a heap"), LIMIT))
                .isEqualTo(new EmptySiphonVerdict.Undecided(
                        "net growing: no bound is known for the tokens of place heap"));
    }

    /** With a wrong bound for a place that holds several tokens, the program would miss the emptied siphon. */
    @Test
    void severalTokens_fillAPlaceUpToItsBound() {
        var net = net("convoy", "near=3 far", "go: near > far");
        assertThat(new StateEquation(net).upperBound(net.place("far"))).hasValue(3);
        assertThat(EmptySiphonProgram.solve(net, LIMIT)).isInstanceOf(EmptySiphonVerdict.MayBeEmptied.class);
    }

    /** A solver that is stopped at once must not count as one that found no solution. */
    @Test
    void programAtItsLimit_isNotDecided() {
        var net = PaperNets.corrected(A);
        assertThat(EmptySiphonProgram.solve(net, Duration.ofNanos(1))).isInstanceOf(EmptySiphonVerdict.Undecided.class);
        refused(() -> EmptySiphonProgram.solve(net, Duration.ZERO), "limit is PT0S, expected longer than zero");
    }

    /** The cases that occurred, which proves that the comparison was not empty. */
    private final Set<String> seen = new HashSet<>();

    /**
     * Small random nets, compared with their markings. If there are too many, the visited ones can still refute a wrong
     * proof. A result without a proof may be right or wrong, and is not compared.
     */
    @ParameterizedTest
    @ValueSource(ints = {1, 2})
    void proofs_areNeverRefutedByAReachableMarking(int maxWeight) {
        for (var seed = 1L; seed <= Thorough.times(250, 500); seed++) {
            var as = "seed " + seed;
            var net = Nets.sparse(seed, maxWeight);
            var graph = ReachabilityGraph.explore(net, 400);
            var analysis = SiphonAnalysis.of(net);
            var equation = new StateEquation(net);

            analysis.verdicts().forEach(verdict -> checkSiphon(as, verdict, equation, graph));
            checkProgram(as, analysis.siphons().sets(), equation, graph);
            if (analysis.deadlock() instanceof NoDeadMarking) {
                seen.add("no dead marking");
                assertThat(graph.dead()).as("dead markings, " + as).isEmpty();
            }
            graph.dead().stream().limit(1).forEach(dead -> seen.add("dead"));
        }
        assertThat(seen)
                .contains("emptied", "by trap", "by state equation", "false candidate", "no dead marking", "dead")
                .contains("program excludes", "program candidate", "program undecided");
    }

    private void checkSiphon(String seed, SiphonVerdict verdict, StateEquation equation, ReachabilityGraph graph) {
        var siphon = verdict.siphon();
        var as = seed + ", " + verdict;
        var tokens = graph.states().stream().mapToLong(state -> siphon.tokens(state.marking()));
        var fewest = tokens.min().orElseThrow();
        assertThat(equation.leastTokens(siphon).orElseThrow()).as(as).isLessThan(fewest + 1e-6);
        equation.lowerBound(siphon)
                .ifPresent(bound -> assertThat(bound.tokens()).as(as).isBetween(1L, fewest));
        assertThat(isEmptied(siphon, graph)).as(as).isEqualTo(fewest == 0);
        switch (verdict) {
            case CannotBeEmptied proved -> {
                assertThat(fewest).as(as).isPositive();
                seen.add(proved instanceof HoldsTokens ? "by state equation" : "by trap");
            }
            case MayBeEmptied open -> seen.add(fewest == 0 ? "emptied" : "false candidate");
            case Emptied unexpected -> assertThat(unexpected).as(as).isNull();
        }
        var trap = Siphons.largestTrapIn(siphon);
        assertThat(verdict instanceof HoldsMarkedTrap)
                .as(as)
                .isEqualTo(trap.isMarked(trap.net().initialMarking()));
    }

    private void checkProgram(String as, List<PlaceSet> siphons, StateEquation equation, ReachabilityGraph graph) {
        switch (EmptySiphonProgram.solve(graph.net(), Duration.ofSeconds(10))) {
            case NoneCanBeEmptied none -> {
                seen.add("program excludes");
                assertThat(siphons).as(as).noneMatch(siphon -> isEmptied(siphon, graph));
                if (none.excludesDeadMarkings()) {
                    assertThat(graph.dead()).as("dead markings, " + as).isEmpty();
                }
            }
            case EmptySiphonVerdict.MayBeEmptied candidate -> {
                seen.add("program candidate");
                // the state equation of the same net cannot prove a token there
                assertThat(siphons).as(as).contains(candidate.siphon());
                assertThat(equation.lowerBound(candidate.siphon())).as(as).isEmpty();
            }
            case EmptySiphonVerdict.Undecided undecided -> {
                seen.add("program undecided");
                assertThat(undecided.reason()).as(as).contains("no bound is known");
            }
        }
    }

    private static boolean isEmptied(PlaceSet siphon, ReachabilityGraph graph) {
        return SiphonAnalysis.confirm(siphon, graph) instanceof Emptied;
    }
}
