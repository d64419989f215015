package io.troupe.petri.drawing;

import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.ReachabilityGraph.State;
import io.troupe.petri.Transition;
import java.util.ArrayList;
import java.util.BitSet;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * The contents common to both kinds of graph drawings: nodes by their number in the graph, and edges, some of them on
 * the coloured path.
 */
final class GraphContent {
    /** An edge between two markings, given by their numbers. */
    record Edge(int from, Transition transition, int to, boolean onPath) {}

    final ReachabilityGraph graph;
    /** Whether the drawing has the text of the markings and the names of all transitions. */
    final boolean written;

    final List<State> states;
    final List<Edge> edges = new ArrayList<>();
    private final BitSet dead = new BitSet();
    private final BitSet onPath = new BitSet();

    GraphContent(ReachabilityGraph graph, @Nullable State end, boolean written) {
        this.graph = graph;
        this.written = written;
        states = graph.states();
        graph.dead().forEach(state -> dead.set(state.index()));
        var firings = new Transition[states.size()];
        if (end != null) {
            walk(end, firings);
        }
        for (var state : states) {
            for (var edge : state.successors()) {
                var coloured = edge.transition().equals(firings[state.index()]);
                edges.add(
                        new Edge(state.index(), edge.transition(), edge.target().index(), coloured));
            }
        }
    }

    /** Records for each state on the path which transition fires there; a shortest path visits no state twice. */
    private void walk(State end, @Nullable Transition[] firings) {
        var at = states.getFirst();
        onPath.set(at.index());
        for (var firing : end.shortestTrace()) {
            firings[at.index()] = firing;
            at = at.successors().stream()
                    .filter(edge -> edge.transition().equals(firing))
                    .findFirst()
                    .orElseThrow()
                    .target();
            onPath.set(at.index());
        }
    }

    boolean isInitial(State state) {
        return state.index() == 0;
    }

    boolean isDead(State state) {
        return dead.get(state.index());
    }

    boolean isOnPath(State state) {
        return onPath.get(state.index());
    }

    boolean isNamed(Edge edge) {
        return written || edge.onPath();
    }

    /** The marked places, one word for each. */
    static List<String> words(State state) {
        var marking = state.marking();
        var words = marking.marked().stream()
                .map(place -> (marking.tokens(place) > 1 ? marking.tokens(place) + "*" : "") + place.name())
                .toList();
        return words.isEmpty() ? List.of("{}") : words;
    }

    /** The properties of the marking that the drawing points out. */
    String remarks(State state) {
        return (isInitial(state) ? ", initial" : "")
                + (isDead(state) ? ", dead" : "")
                + (state.isOpen() ? ", successors missing" : "");
    }

    String title(State state) {
        return "marking " + state.index() + ": " + state + remarks(state);
    }

    String title(Edge edge) {
        return edge.transition().name() + ": " + states.get(edge.from()) + " → " + states.get(edge.to());
    }

    String classes(State state) {
        return "state"
                + (isInitial(state) ? " initial" : "")
                + (isDead(state) ? " dead" : "")
                + (state.isOpen() ? " open" : "")
                + (isOnPath(state) ? " path" : "");
    }

    String fill(State state) {
        if (isDead(state)) {
            return Palette.DEAD_FILL;
        }
        return isOnPath(state) ? Palette.PATH_FILL : "white";
    }
}
