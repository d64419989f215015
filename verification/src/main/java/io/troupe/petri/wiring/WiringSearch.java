package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.ProgressSearch;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.ReachabilityGraph.State;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.TreeMap;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

/** Finds the dead markings and blocks in the graph of some components of a wiring. */
final class WiringSearch {
    /** Enough to see what is wrong; the figures count all of them. */
    private static final int MAX_COUNTEREXAMPLES = 16;

    private final WiringNet net;
    private final ReachabilityGraph graph;
    private final Explainer explainer;

    /** Creates a search of the graph of {@code net}, or of a net that differs from it in names only. */
    WiringSearch(Wiring wiring, WiringNet net, ReachabilityGraph graph) {
        this.net = net;
        this.graph = graph;
        explainer = new Explainer(wiring, net);
    }

    Figures figures() {
        return Figures.of(net.net(), graph);
    }

    /** The counterexamples of the dead markings, nearest first. */
    List<Counterexample> deadlocks() {
        return graph.dead().stream()
                .limit(MAX_COUNTEREXAMPLES)
                .map(state -> explainer.explain(state.marking(), state.shortestTrace(), true, net.chosen()))
                .toList();
    }

    /** The counterexample of a dead marking that need not be the nearest. */
    Counterexample deadlock(DeadlockSearch.Deadlock found) {
        return explainer.explain(found.marking(), found.trace(), false, net.chosen());
    }

    /** The counterexamples of these dead markings, in their order. */
    List<Counterexample> deadlocks(List<DeadlockSearch.Deadlock> dead) {
        return dead.stream()
                .limit(MAX_COUNTEREXAMPLES)
                .map(deadlock -> explainer.explain(deadlock.marking(), deadlock.trace(), true, net.chosen()))
                .toList();
    }

    /**
     * The counterexamples of the nearest markings from which a component never takes a step again, whatever the others
     * do. Empty for an incomplete graph: markings beyond the limit might lead to such a step.
     */
    List<Counterexample> blocks() {
        if (!graph.isComplete()) {
            return List.of();
        }
        var moves = moves();
        Map<Integer, Set<String>> nearest = new TreeMap<>();
        moves.forEach((component, canMove) -> {
            for (var i = 0; i < canMove.length; i++) {
                if (!canMove[i]) {
                    nearest.put(i, stuckIn(i, moves));
                    break;
                }
            }
        });
        var found = new ArrayList<Counterexample>();
        var states = nearest.isEmpty() ? List.<State>of() : graph.states();
        nearest.forEach((index, stuck) -> {
            var state = states.get(index);
            found.add(explainer.explain(state.marking(), state.shortestTrace(), true, stuck));
        });
        return withCircles(found);
    }

    /** How a component can come to wait for ever, for a complete graph; the nearest such marking. */
    Optional<Counterexample> block(String component) {
        var canMove = requireNonNull(moves().get(component));
        return IntStream.range(0, canMove.length)
                .filter(i -> !canMove[i])
                .mapToObj(graph.states()::get)
                .findFirst()
                .map(state -> explainer.explain(state.marking(), state.shortestTrace(), true, Set.of(component)));
    }

    /** The counterexamples of the losses after which a component never takes a step again. */
    List<Counterexample> blocks(List<ProgressSearch.Loss> losses) {
        var found = new LinkedHashMap<Set<String>, Counterexample>();
        for (var loss : losses) {
            var stuck = new LinkedHashSet<>(net.chosen());
            net.net().transitions().stream()
                    .filter(transition -> !loss.lost().contains(transition))
                    .forEach(transition -> stuck.removeAll(net.event(transition).who()));
            stuck.removeAll(net.ended(loss.marking()));
            if (!stuck.isEmpty() && !found.containsKey(stuck)) {
                found.put(stuck, explainer.explain(loss.marking(), loss.trace(), false, stuck));
            }
        }
        return found.values().stream().limit(MAX_COUNTEREXAMPLES).toList();
    }

    /**
     * Leaves out counterexamples of components that wait without a circle but are in the circle of another
     * counterexample, which explains more.
     */
    private static List<Counterexample> withCircles(List<Counterexample> found) {
        var explained = found.stream()
                .flatMap(counterexample -> counterexample.circle().stream())
                .map(Wait::component)
                .collect(Collectors.toSet());
        return found.stream()
                .filter(counterexample -> !counterexample.circle().isEmpty()
                        || !counterexample.waits().stream().map(Wait::component).allMatch(explained::contains))
                .toList();
    }

    private static Set<String> stuckIn(int state, Map<String, boolean[]> moves) {
        var stuck = new LinkedHashSet<String>();
        moves.forEach((component, canMove) -> {
            if (!canMove[state]) {
                stuck.add(component);
            }
        });
        return stuck;
    }

    /** By component: the markings from which a firing sequence leads to a step of it, or to where it has ended. */
    private Map<String, boolean[]> moves() {
        var size = graph.size();
        var states = graph.states();
        var moves = new LinkedHashMap<String, boolean[]>();
        net.chosen().forEach(component -> moves.put(component, new boolean[size]));
        var movedBy = net.net().transitions().stream()
                .map(transition -> net.event(transition).who().stream()
                        .map(component -> requireNonNull(moves.get(component)))
                        .toList())
                .toList();
        // The edges by target: those to marking i are sources[starts[i]] up to sources[starts[i + 1]].
        var starts = new int[size + 2];
        for (var state : states) {
            state.successors().forEach(edge -> starts[edge.target().index() + 2]++);
        }
        Arrays.parallelPrefix(starts, Integer::sum);
        var sources = new int[graph.edgeCount()];
        for (var state : states) {
            if (net.someEnd()) {
                net.ended(state.marking()).forEach(ended -> requireNonNull(moves.get(ended))[state.index()] = true);
            }
            for (var edge : state.successors()) {
                sources[starts[edge.target().index() + 1]++] = state.index();
                movedBy.get(edge.transition().index()).forEach(moved -> moved[state.index()] = true);
            }
        }
        moves.values().forEach(reached -> spread(reached, starts, sources));
        return moves;
    }

    /** Adds all markings that lead to one of {@code reached}. */
    private static void spread(boolean[] reached, int[] starts, int[] sources) {
        var ahead = new ArrayDeque<Integer>();
        for (var i = 0; i < reached.length; i++) {
            if (reached[i]) {
                ahead.add(i);
            }
        }
        while (!ahead.isEmpty()) {
            var at = ahead.remove();
            for (var i = starts[at]; i < starts[at + 1]; i++) {
                if (!reached[sources[i]]) {
                    reached[sources[i]] = true;
                    ahead.add(sources[i]);
                }
            }
        }
    }
}
