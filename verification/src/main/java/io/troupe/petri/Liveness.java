package io.troupe.petri;

import java.util.Arrays;
import java.util.List;
import java.util.Optional;

/**
 * What stays possible for ever after any firing sequence: terminal components, live transitions, reversibility.
 *
 * <p><b>Role.</b> Made by {@link #of} from a {@link ReachabilityGraph}. If the graph is incomplete, only the certain
 * terminal components are given, which are those without an open marking; verdicts are then {@link Verdict#NO} or
 * {@link Verdict#UNKNOWN}.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Cost.</b> Time in proportion to markings + edges. Memory: 24 bytes for each marking while it is computed, then
 * 4 bytes for each marking of a terminal component.
 *
 * <p><b>Source.</b> R. Tarjan, Depth-first search and linear graph algorithms, 1972; T. Murata, Petri nets: properties,
 * analysis and applications, 1989, for the terms.
 */
public final class Liveness {
    /** The most components that {@link #summary} lists; an unbounded net can have a million. */
    private static final int MAX_LISTED = 16;

    private final ReachabilityGraph graph;
    private final List<TerminalComponent> components;

    private Liveness(ReachabilityGraph graph) {
        this.graph = graph;
        components = Arrays.stream(StrongComponents.terminal(graph.found()))
                .map(members -> new TerminalComponent(graph, members))
                .toList();
    }

    /**
     * Computes the terminal components.
     *
     * @throws IllegalArgumentException if the graph was explored without edges, or by the orbits of a symmetry
     */
    public static Liveness of(ReachabilityGraph graph) {
        if (!graph.hasEdges()) {
            throw new IllegalArgumentException("the graph of net " + graph.net().name()
                    + " has no edges, expected one made by ReachabilityGraph.explore");
        }
        if (!graph.symmetry().isTrivial()) {
            throw new IllegalArgumentException("the graph of net " + graph.net().name()
                    + " has one marking of each orbit, expected one with all markings");
        }
        return new Liveness(graph);
    }

    public ReachabilityGraph graph() {
        return graph;
    }

    /**
     * The terminal strongly connected components, the one with the nearest marking first. If the graph is incomplete,
     * there may be others.
     */
    public List<TerminalComponent> terminalComponents() {
        return components;
    }

    /** Whether every transition is live. */
    public Verdict live() {
        var certain =
                components.stream().allMatch(component -> component.neverFired().isEmpty());
        return verdict(certain);
    }

    /** Whether {@code transition} is live: from every reachable marking, a firing sequence contains it. */
    public Verdict live(Transition transition) {
        return verdict(lossOf(transition).isEmpty());
    }

    /** The transitions that are certainly not live; if the graph is incomplete, there may be others. */
    public List<Transition> notLive() {
        return graph.net().transitions().stream()
                .filter(t -> lossOf(t).isPresent())
                .toList();
    }

    /** The nearest terminal component in which {@code transition} never fires, which proves that it is not live. */
    public Optional<TerminalComponent> lossOf(Transition transition) {
        // also rejects a transition of another net where there are no components
        graph.net().transition(transition.name());
        return components.stream()
                .filter(component -> !component.fires(transition))
                .findFirst();
    }

    /** Whether the initial marking can be reached again from every reachable marking. */
    public Verdict reversible() {
        return verdict(components.stream().allMatch(component -> component.contains(graph.state(0))));
    }

    /**
     * The minimal sets of up to {@code maxPlaces} places that stay marked for ever once all of them are marked. Smaller
     * sets come first, then nearer ones. Places that are marked in every marking are left out. A place in which a
     * component just ends, such as "finished", is such a set too. If the graph is incomplete, these are the sets that
     * the known {@link #terminalComponents} keep marked and that no known edge empties.
     *
     * <p><b>Cost.</b> One pass over all edges for each size. The number of candidate sets grows with the power
     * {@code maxPlaces} of the number of places that stay marked in a terminal component.
     *
     * @param maxPlaces 1 or more; the number of components that may wait for each other in a circle
     */
    public List<PermanentBlock> permanentBlocks(int maxPlaces) {
        if (maxPlaces < 1) {
            throw new IllegalArgumentException("maxPlaces is " + maxPlaces + ", expected 1 or more");
        }
        return new BlockSearch(graph).blocks(components, maxPlaces);
    }

    private Verdict verdict(boolean notRefuted) {
        if (!notRefuted) {
            return Verdict.NO;
        }
        return graph.isComplete() ? Verdict.YES : Verdict.UNKNOWN;
    }

    /** In a few lines: the result and, if the graph is incomplete, what is not known. */
    public String summary() {
        var text = new StringBuilder(graph.net().name()).append(": live ").append(live());
        text.append(", reversible ").append(reversible());
        text.append("\n  terminal components").append(graph.isComplete() ? "" : " so far");
        text.append(": ").append(components.size());
        components.stream()
                .limit(MAX_LISTED)
                .forEach(component -> text.append("\n    ").append(component));
        if (components.size() > MAX_LISTED) {
            text.append("\n    and ").append(components.size() - MAX_LISTED).append(" more");
        }
        if (!graph.isComplete()) {
            text.append("\n  ").append(graph.openCount());
            text.append(" markings may lead to other components, which were not visited");
        }
        return text.toString();
    }

    /** The first line of {@link #summary}. */
    @Override
    public String toString() {
        return summary().lines().findFirst().orElseThrow();
    }
}
