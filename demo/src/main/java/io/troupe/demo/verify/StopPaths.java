package io.troupe.demo.verify;

import io.troupe.petri.Marking;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.ReachabilityGraph.Edge;
import io.troupe.petri.ReachabilityGraph.State;
import io.troupe.petri.Transition;
import java.util.ArrayDeque;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.OptionalInt;

/** Analyses the paths through a graph up to the firing of {@code stop}. */
record StopPaths(ReachabilityGraph graph, Transition stop) {
    /**
     * The largest number of other firings before {@code stop} fires, from any marking with {@code wanting} marked.
     * Empty if there is no such marking, or if some path avoids {@code stop}: by a cycle, a dead marking, or another
     * transition that takes the tokens.
     */
    OptionalInt longest(Marking wanting) {
        var known = new HashMap<State, OptionalInt>();
        return graph.states().stream()
                .filter(state -> state.marking().covers(wanting))
                .map(state -> longest(state, wanting, known))
                .reduce(StopPaths::longer)
                .orElse(OptionalInt.empty());
    }

    /** Recursive; the graph has some hundred markings, so the recursion is not deep. */
    private OptionalInt longest(State from, Marking wanting, Map<State, OptionalInt> known) {
        var before = known.get(from);
        if (before != null) {
            return before;
        }
        known.put(from, OptionalInt.empty()); // marks the state as in progress: reaching it again is a cycle
        var longest = from.successors().stream()
                .map(edge -> rest(edge, wanting, known))
                .reduce(StopPaths::longer)
                .orElse(OptionalInt.empty());
        known.put(from, longest);
        return longest;
    }

    private OptionalInt rest(Edge edge, Marking wanting, Map<State, OptionalInt> known) {
        if (edge.transition().equals(stop)) {
            return OptionalInt.of(0);
        }
        if (!edge.target().marking().covers(wanting)) {
            return OptionalInt.empty();
        }
        var rest = longest(edge.target(), wanting, known);
        return rest.isPresent() ? OptionalInt.of(rest.getAsInt() + 1) : rest;
    }

    private static OptionalInt longer(OptionalInt one, OptionalInt other) {
        return one.isEmpty() || other.isEmpty()
                ? OptionalInt.empty()
                : OptionalInt.of(Math.max(one.getAsInt(), other.getAsInt()));
    }

    /** Whether {@code transition} can fire twice without {@code stop} in between. */
    boolean canRepeat(Transition transition) {
        List<State> after = graph.states().stream()
                .flatMap(state -> state.successors().stream())
                .filter(edge -> edge.transition().equals(transition))
                .map(Edge::target)
                .toList();
        var seen = new HashSet<>(after);
        var ahead = new ArrayDeque<>(seen);
        while (!ahead.isEmpty()) {
            for (var edge : ahead.remove().successors()) {
                if (edge.transition().equals(transition)) {
                    return true;
                }
                if (!edge.transition().equals(stop) && seen.add(edge.target())) {
                    ahead.add(edge.target());
                }
            }
        }
        return false;
    }
}
