package io.troupe.petri;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.ReachabilityGraph.State;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.BitSet;
import java.util.Collections;
import java.util.HashMap;
import java.util.List;
import java.util.function.Predicate;

/**
 * Decides what happens in every fair run: that a marking of one kind is always followed by one of another kind, and
 * that a kind of marking occurs again and again.
 *
 * <p>A run is fair if a firing that is possible infinitely often happens infinitely often. Each fair run of a finite
 * graph ends in a {@link TerminalComponent} and visits all of it, so the answers are exact. They do not limit how long
 * it takes.
 *
 * {@snippet :
 * var runs = FairRuns.of(ReachabilityGraph.explore(net));
 * var answer = runs.leadsTo(marking -> marking.tokens(waiting) > 0, marking -> marking.tokens(served) > 0);
 * }
 *
 * <p><b>Role.</b> For questions about wirings use {@link io.troupe.petri.wiring.WiringProgress}.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Cost.</b> Per question the time of one pass over all markings and edges; 8 bytes for each edge once.
 *
 * <p><b>Errors.</b> {@link #of} throws {@link IllegalArgumentException} for a graph that was explored without edges.
 */
public final class FairRuns {
    private final ReachabilityGraph graph;
    private final List<TerminalComponent> ends;
    /** The edges by target: those to marking i are sources[starts[i]] up to sources[starts[i + 1]]. */
    private final int[] starts;

    private final int[] sources;

    private FairRuns(ReachabilityGraph graph) {
        this.graph = graph;
        ends = Liveness.of(graph).terminalComponents();
        starts = new int[graph.size() + 2];
        forEachEdge((from, to) -> starts[to + 2]++);
        Arrays.parallelPrefix(starts, Integer::sum);
        sources = new int[starts[graph.size() + 1]];
        forEachEdge((from, to) -> sources[starts[to + 1]++] = from);
    }

    private interface EdgeVisitor {
        void visit(int from, int to);
    }

    private void forEachEdge(EdgeVisitor visitor) {
        var found = graph.found();
        for (var from = 0; from < graph.size(); from++) {
            for (var edge = found.edgeStart(from); edge < found.edgeEnd(from); edge++) {
                visitor.visit(from, found.edgeTarget.get(edge));
            }
        }
    }

    /** Prepares the questions about a graph. */
    public static FairRuns of(ReachabilityGraph graph) {
        return new FairRuns(graph);
    }

    /**
     * How some fair run avoids what was asked for.
     *
     * @param trace firings from the initial marking to {@code marking}
     * @param marking the nearest one from which a fair run may avoid the goal
     * @param way firings from there, past no goal, into {@code forever}
     * @param forever where the run stays, without a goal
     */
    public record Fails(List<Transition> trace, Marking marking, List<Transition> way, TerminalComponent forever) {
        public Fails {
            trace = List.copyOf(trace);
            way = List.copyOf(way);
        }
    }

    /** Whether every fair run reaches markings of this kind again and again. */
    public Answer<Fails> alwaysAgain(Predicate<Marking> goal) {
        return leadsTo(marking -> true, goal);
    }

    /** Whether in every fair run each marking of the kind {@code when} is, or is followed by, a {@code goal}. */
    public Answer<Fails> leadsTo(Predicate<Marking> when, Predicate<Marking> goal) {
        var goals = new BitSet();
        var asked = new BitSet();
        for (var state : graph.states()) {
            var marking = state.marking();
            goals.set(state.index(), goal.test(marking));
            asked.set(state.index(), when.test(marking));
        }
        var avoiding = new BitSet();
        var ahead = new ArrayDeque<Integer>();
        for (var end : ends) {
            if (Arrays.stream(end.members()).noneMatch(goals::get)) {
                Arrays.stream(end.members()).forEach(member -> {
                    avoiding.set(member);
                    ahead.add(member);
                });
            }
        }
        while (!ahead.isEmpty()) {
            var at = ahead.remove();
            for (var i = starts[at]; i < starts[at + 1]; i++) {
                var source = sources[i];
                if (!goals.get(source) && !avoiding.get(source)) {
                    avoiding.set(source);
                    ahead.add(source);
                }
            }
        }
        for (var at = asked.nextSetBit(0); at >= 0; at = asked.nextSetBit(at + 1)) {
            if (avoiding.get(at)) {
                return new Answer.No<>(fails(graph.state(at), avoiding));
            }
        }
        return graph.isComplete()
                ? new Answer.Yes<>("all fair runs", graph.size())
                : new Answer.Unknown<>(graph.end(), graph.size());
    }

    /** A shortest way from a marking into a terminal component, among the markings that avoid the goal. */
    private Fails fails(State from, BitSet avoiding) {
        var found = graph.found();
        var cameFrom = new HashMap<Integer, int[]>();
        var ahead = new ArrayDeque<>(List.of(from.index()));
        while (!ahead.isEmpty()) {
            var at = ahead.remove();
            for (var end : ends) {
                if (Arrays.binarySearch(end.members(), at) >= 0) {
                    return new Fails(from.shortestTrace(), from.marking(), way(from.index(), at, cameFrom), end);
                }
            }
            for (var edge = found.edgeStart(at); edge < found.edgeEnd(at); edge++) {
                var to = found.edgeTarget.get(edge);
                if (avoiding.get(to)
                        && to != from.index()
                        && cameFrom.putIfAbsent(to, new int[] {at, found.edgeTransition.get(edge)}) == null) {
                    ahead.add(to);
                }
            }
        }
        throw new IllegalStateException("no way from " + from + " to a terminal component");
    }

    private List<Transition> way(int from, int to, HashMap<Integer, int[]> cameFrom) {
        var way = new ArrayList<Transition>();
        for (var at = to; at != from; ) {
            var step = requireNonNull(cameFrom.get(at));
            way.add(graph.net().transitions().get(step[1]));
            at = step[0];
        }
        Collections.reverse(way);
        return way;
    }
}
