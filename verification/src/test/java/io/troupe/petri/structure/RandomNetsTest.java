package io.troupe.petri.structure;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.PetriNet;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.structure.SiphonVerdict.CannotBeEmptied;
import io.troupe.petri.structure.SiphonVerdict.Emptied;
import io.troupe.petri.structure.SiphonVerdict.HoldsMarkedTrap;
import io.troupe.petri.structure.SiphonVerdict.HoldsTokens;
import java.time.Duration;
import java.util.EnumMap;
import java.util.Map;
import java.util.stream.Collectors;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/**
 * Small random nets, compared with all their sets of places and their markings. If there are too many markings, the
 * visited ones can still refute a wrong proof. A result without a proof may be right or wrong, and is not compared.
 */
class RandomNetsTest {
    private static final int MAX_MARKINGS = 400;

    /** The cases that occurred, which proves that the comparison was not empty. */
    private enum Case {
        EMPTIED,
        BY_TRAP,
        BY_STATE_EQUATION,
        FALSE_CANDIDATE,
        NO_DEAD_MARKING,
        DEAD,
        PROGRAM_EXCLUDES,
        PROGRAM_CANDIDATE,
        PROGRAM_UNDECIDED
    }

    private final Map<Case, Integer> seen = new EnumMap<>(Case.class);

    private void saw(Case what) {
        seen.merge(what, 1, Integer::sum);
    }

    @Test
    void minimalSiphonsAndTraps_areThoseOfTheDefinition() {
        for (var seed = 1L; seed <= 3_000; seed++) {
            var net = Nets.random(seed, 1);
            var siphons = Siphons.minimalSiphons(net).sets();
            var traps = Siphons.minimalTraps(net).sets();

            assertThat(siphons).as("seed %d", seed).doesNotHaveDuplicates();
            assertThat(siphons.stream().collect(Collectors.toSet()))
                    .as("siphons, seed %d", seed)
                    .isEqualTo(new StructureOracle(net, false).minimal());
            assertThat(traps).as("seed %d", seed).doesNotHaveDuplicates();
            assertThat(traps.stream().collect(Collectors.toSet()))
                    .as("traps, seed %d", seed)
                    .isEqualTo(new StructureOracle(net, true).minimal());
        }
    }

    @Test
    void largestSiphonAndTrap_inEverySet_areThoseOfTheDefinition() {
        for (var seed = 1L; seed <= 150; seed++) {
            var net = Nets.random(seed, 1);
            var siphons = new StructureOracle(net, false);
            var traps = new StructureOracle(net, true);
            for (var mask : siphons.subsets().toArray()) {
                var set = siphons.set(mask);
                assertThat(Siphons.isSiphon(set)).as("seed %d, %s", seed, set).isEqualTo(siphons.isClosed(mask));
                assertThat(Siphons.isTrap(set)).as("seed %d, %s", seed, set).isEqualTo(traps.isClosed(mask));
                assertThat(Siphons.largestSiphonIn(set))
                        .as("seed %d, %s", seed, set)
                        .isEqualTo(siphons.largestIn(mask));
                assertThat(Siphons.largestTrapIn(set))
                        .as("seed %d, %s", seed, set)
                        .isEqualTo(traps.largestIn(mask));
            }
        }
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 2})
    void proofs_areNeverRefutedByAReachableMarking(int maxWeight) {
        for (var seed = 1L; seed <= 500; seed++) {
            var net = Nets.random(seed, maxWeight);
            var graph = ReachabilityGraph.explore(net, MAX_MARKINGS);
            var analysis = SiphonAnalysis.of(net);
            var equation = new StateEquation(net);

            for (var verdict : analysis.verdicts()) {
                checkSiphon(seed, verdict, equation, graph);
            }
            if (analysis.deadlock() instanceof DeadlockVerdict.NoDeadMarking) {
                saw(Case.NO_DEAD_MARKING);
                assertThat(graph.dead()).as("dead markings, seed %d", seed).isEmpty();
            }
            graph.dead().stream().limit(1).forEach(dead -> saw(Case.DEAD));
        }
        assertThat(seen)
                .containsKeys(
                        Case.EMPTIED, Case.BY_TRAP, Case.BY_STATE_EQUATION, Case.FALSE_CANDIDATE, Case.NO_DEAD_MARKING)
                .containsKey(Case.DEAD);
    }

    private void checkSiphon(long seed, SiphonVerdict verdict, StateEquation equation, ReachabilityGraph graph) {
        var siphon = verdict.siphon();
        var fewest = graph.states().stream()
                .mapToLong(state -> siphon.tokens(state.marking()))
                .min()
                .orElseThrow();
        var least = equation.leastTokens(siphon).orElseThrow();
        assertThat(least).as("least tokens of %s, seed %d", siphon, seed).isLessThan(fewest + 1e-6);
        equation.lowerBound(siphon)
                .ifPresent(bound -> assertThat(bound.tokens())
                        .as("%s, seed %d", bound, seed)
                        .isBetween(1L, fewest));
        var confirmed = SiphonAnalysis.confirm(siphon, graph);
        assertThat(confirmed instanceof Emptied).as("%s, seed %d", siphon, seed).isEqualTo(fewest == 0);
        switch (verdict) {
            case CannotBeEmptied proved -> {
                assertThat(fewest).as("%s, seed %d", proved, seed).isPositive();
                saw(proved instanceof HoldsTokens ? Case.BY_STATE_EQUATION : Case.BY_TRAP);
            }
            case SiphonVerdict.MayBeEmptied open -> saw(fewest == 0 ? Case.EMPTIED : Case.FALSE_CANDIDATE);
            case Emptied unexpected -> assertThat(unexpected).isNull();
        }
        var trap = Siphons.largestTrapIn(siphon);
        assertThat(verdict instanceof HoldsMarkedTrap)
                .as("%s, seed %d", siphon, seed)
                .isEqualTo(trap.isMarked(trap.net().initialMarking()));
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 2})
    void program_neverExcludesWhatAReachableMarkingShows(int maxWeight) {
        for (var seed = 1L; seed <= 400; seed++) {
            var net = Nets.random(seed, maxWeight);
            checkProgram(seed, net, ReachabilityGraph.explore(net, MAX_MARKINGS));
        }
        assertThat(seen).containsKeys(Case.PROGRAM_EXCLUDES, Case.PROGRAM_CANDIDATE, Case.PROGRAM_UNDECIDED);
    }

    private void checkProgram(long seed, PetriNet net, ReachabilityGraph graph) {
        var siphons = Siphons.minimalSiphons(net).sets();
        switch (EmptySiphonProgram.solve(net, Duration.ofSeconds(10))) {
            case EmptySiphonVerdict.NoneCanBeEmptied none -> {
                saw(Case.PROGRAM_EXCLUDES);
                assertThat(siphons)
                        .as("seed %d", seed)
                        .noneMatch(siphon -> SiphonAnalysis.confirm(siphon, graph) instanceof Emptied);
                if (none.excludesDeadMarkings()) {
                    assertThat(graph.dead()).as("dead markings, seed %d", seed).isEmpty();
                }
            }
            case EmptySiphonVerdict.MayBeEmptied candidate -> {
                saw(Case.PROGRAM_CANDIDATE);
                // the state equation of the same net cannot prove a token there
                assertThat(siphons).as("seed %d", seed).contains(candidate.siphon());
                assertThat(new StateEquation(net).lowerBound(candidate.siphon()))
                        .as("seed %d", seed)
                        .isEmpty();
            }
            case EmptySiphonVerdict.Undecided undecided -> {
                saw(Case.PROGRAM_UNDECIDED);
                assertThat(undecided.reason()).as("seed %d", seed).contains("no bound is known");
            }
        }
    }
}
