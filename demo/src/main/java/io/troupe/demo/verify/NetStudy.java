package io.troupe.demo.verify;

import io.troupe.petri.Liveness;
import io.troupe.petri.Marking;
import io.troupe.petri.PetriNet;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.Verdict;
import io.troupe.petri.structure.MinimalSets;
import io.troupe.petri.structure.PlaceSet;
import io.troupe.petri.structure.Siphons;
import io.troupe.petri.structure.StateEquation;
import java.util.List;

/**
 * Analysis results of one net: its reachability graph, and its siphons checked in three independent ways.
 *
 * @param emptied minimal siphons that are empty in some reachable marking
 * @param leastTokens for each minimal siphon the fewest tokens in it by the state equation (linear program)
 * @param withoutMarkedTrap minimal siphons that contain no initially marked trap
 */
record NetStudy(
        PetriNet net,
        ReachabilityGraph graph,
        Liveness liveness,
        MinimalSets siphons,
        MinimalSets traps,
        List<PlaceSet> emptied,
        List<Double> leastTokens,
        List<PlaceSet> withoutMarkedTrap) {
    /** Tolerance for rounding errors of a linear program. */
    private static final double ROUNDING = 1e-6;

    static NetStudy of(PetriNet net) {
        var graph = ReachabilityGraph.explore(net);
        var siphons = Siphons.minimalSiphons(net);
        if (!graph.isComplete() || !siphons.isComplete()) {
            throw new IllegalArgumentException(
                    "net " + net.name() + " is too large for a statement about all its markings and siphons: " + graph);
        }
        var equation = new StateEquation(net);
        return new NetStudy(
                net,
                graph,
                Liveness.of(graph),
                siphons,
                Siphons.minimalTraps(net),
                siphons.sets().stream()
                        .filter(siphon -> graph.states().stream().anyMatch(state -> !siphon.isMarked(state.marking())))
                        .toList(),
                siphons.sets().stream()
                        .map(siphon -> equation.leastTokens(siphon)
                                .orElseThrow(() -> new IllegalStateException(
                                        "the linear program for " + siphon + " of net " + net.name() + " failed")))
                        .toList(),
                siphons.sets().stream()
                        .filter(siphon -> !Siphons.largestTrapIn(siphon).isMarked(net.initialMarking()))
                        .toList());
    }

    int emptiedByTheStateEquation() {
        return (int) leastTokens.stream().filter(least -> least < ROUNDING).count();
    }

    double fewestTokens() {
        return leastTokens.stream().mapToDouble(Double::doubleValue).min().orElse(Double.POSITIVE_INFINITY);
    }

    boolean deadlockFree() {
        return graph.deadlockFree() == Verdict.YES;
    }

    /** Number of reachable markings in which all these places are marked. */
    int markingsWith(Marking places) {
        return (int) graph.states().stream()
                .filter(state -> state.marking().covers(places))
                .count();
    }
}
