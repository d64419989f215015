package io.troupe.petri;

import java.util.Arrays;
import java.util.List;
import java.util.Optional;

/**
 * What can still happen for ever, whatever happened before: terminal components, live transitions, reversibility.
 *
 * <p><b>Role.</b> Made by {@link #of} from a {@link ReachabilityGraph}. A graph that is not complete gives only the
 * components that are certain, those without an open marking; verdicts are then {@link Verdict#NO} or
 * {@link Verdict#UNKNOWN}.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Cost.</b> Time in proportion to markings + edges; 24 bytes for each marking while it is made, 4 bytes for each
 * marking of a terminal component afterwards.
 *
 * <p><b>Source.</b> R. Tarjan, Depth-first search and linear graph algorithms, 1972; T. Murata, Petri nets: properties,
 * analysis and applications, 1989, for the terms.
 */
public final class Liveness {
    /** A net without bounds can have a million components. */
    private static final int MOST_TOLD = 16;

    private final ReachabilityGraph graph;
    private final List<TerminalComponent> components;

    private Liveness(ReachabilityGraph graph) {
        this.graph = graph;
        components = Arrays.stream(StrongComponents.terminal(graph.found()))
                .map(members -> new TerminalComponent(graph, members))
                .toList();
    }

    public static Liveness of(ReachabilityGraph graph) {
        return new Liveness(graph);
    }

    public ReachabilityGraph graph() {
        return graph;
    }

    /**
     * The terminal strongly connected components, that with the nearest marking first. If the graph is not complete,
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

    /** Whether {@code transition} can fire again after whatever happened before. */
    public Verdict live(Transition transition) {
        return verdict(lossOf(transition).isEmpty());
    }

    /** The transitions that are certainly not live; if the graph is not complete, there may be others. */
    public List<Transition> notLive() {
        return graph.net().transitions().stream()
                .filter(t -> lossOf(t).isPresent())
                .toList();
    }

    /** The nearest terminal component in which {@code transition} never fires: the proof that it is not live. */
    public Optional<TerminalComponent> lossOf(Transition transition) {
        // asked of each, so that a transition of another net is refused even where there are no components
        graph.net().transition(transition.name());
        return components.stream()
                .filter(component -> !component.fires(transition))
                .findFirst();
    }

    /** Whether the initial marking can be reached again from every reachable one. */
    public Verdict reversible() {
        return verdict(components.stream().allMatch(component -> component.contains(graph.state(0))));
    }

    /**
     * The smallest sets of up to {@code maxPlaces} places that are never left once all of them are marked, fewer places
     * first, then the nearest; without places that are marked in every marking. A place in which a component merely
     * ends, such as "finished", is one too. If the graph is not complete, these are the ones within the
     * {@link #terminalComponents} known that were not seen to be left so far.
     *
     * <p><b>Cost.</b> For each size a pass over all edges; the number of sets to try grows with the power
     * {@code maxPlaces} of the number of places that stay marked in a terminal component.
     *
     * @param maxPlaces 1 or more; as many components as may wait for each other in a circle
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

    /** In a few lines what is known and, when the graph is not complete, what is not. */
    public String summary() {
        var text = new StringBuilder(graph.net().name()).append(": live ").append(live());
        text.append(", reversible ").append(reversible());
        text.append("\n  terminal components").append(graph.isComplete() ? "" : " so far");
        text.append(": ").append(components.size());
        components.stream()
                .limit(MOST_TOLD)
                .forEach(component -> text.append("\n    ").append(component));
        if (components.size() > MOST_TOLD) {
            text.append("\n    and ").append(components.size() - MOST_TOLD).append(" more");
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
