package io.troupe.petri;

import static java.util.Objects.requireNonNull;

import java.util.List;

/**
 * Finds out which transitions can always fire again, whatever happened before, without visiting all markings.
 *
 * <p>The reduced graph of {@link DeadlockSearch} may go round in a loop for ever and put off what is ready beside it.
 * Here such loops are opened until none is left. Then a transition that can fire after some marking of the full graph
 * can fire after a marking of the reduced one, and the reverse: so the terminal components of both lose the same
 * transitions.
 *
 * <p><b>Role.</b> Made by {@link #run}; the quick way to what {@link Liveness} tells of transitions.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Cost.</b> As for {@link DeadlockSearch}, once more for each time that loops are opened. Components that go
 * round on their own, without the others, are multiplied as in the full graph.
 *
 * <p><b>Source.</b> A. Valmari, Stubborn sets for reduced state space generation, 1989, and Stop it, and be stubborn!,
 * 2015, on the ignoring problem.
 */
public final class ProgressSearch {
    private static final int MAX_ROUNDS = 100;

    private final ReachabilityGraph visited;
    private final SearchEnd end;
    private final List<Loss> losses;

    private ProgressSearch(ReachabilityGraph visited, SearchEnd end, List<Loss> losses) {
        this.visited = visited;
        this.end = end;
        this.losses = losses;
    }

    /**
     * After it, some transitions never fire again, and every other one can always fire again.
     *
     * @param marking the first one of this kind that was met
     * @param trace a firing sequence from the initial marking; not always a shortest one, unless the marking is dead
     * @param lost what never fires again: all transitions if the marking is dead
     */
    public record Loss(Marking marking, List<Transition> trace, List<Transition> lost) {
        public Loss {
            requireNonNull(marking, "marking");
            trace = List.copyOf(trace);
            lost = List.copyOf(lost);
        }
    }

    /**
     * Searches as far as {@code limits} allow, each time that loops are opened.
     *
     * @throws ArithmeticException if a place can hold more than {@link Integer#MAX_VALUE} tokens
     */
    public static ProgressSearch run(PetriNet net, SearchLimits limits) {
        var sets = new FairStubbornSets(net);
        var rules = new FiringRules(net);
        var graph = ReachabilityGraph.explore(net, sets, limits);
        for (var round = 1; graph.isComplete() && round < MAX_ROUNDS; round++) {
            var components = Liveness.of(graph).terminalComponents();
            var closed = components.stream()
                    .filter(component -> ignoresOthers(component, net, rules))
                    .toList();
            if (closed.isEmpty()) {
                return new ProgressSearch(graph, SearchEnd.COMPLETE, losses(components));
            }
            closed.forEach(sets::open);
            graph = ReachabilityGraph.explore(net, sets, limits);
        }
        return new ProgressSearch(graph, graph.isComplete() ? SearchEnd.LIMIT : graph.end(), List.of());
    }

    /** What is ready beside a loop of stubborn sets stays ready all the way round, so one marking tells. */
    private static boolean ignoresOthers(TerminalComponent component, PetriNet net, FiringRules rules) {
        var ready = new int[net.transitions().size()];
        var count = rules.choose(component.entry().marking().toArray(), ready);
        for (var i = 0; i < count; i++) {
            if (!component.fires(net.transitions().get(ready[i]))) {
                return true;
            }
        }
        return false;
    }

    private static List<Loss> losses(List<TerminalComponent> components) {
        return components.stream()
                .filter(component -> !component.neverFired().isEmpty())
                .map(component -> new Loss(
                        component.entry().marking(), component.entry().shortestTrace(), component.neverFired()))
                .toList();
    }

    public PetriNet net() {
        return visited.net();
    }

    /** All ways in which the net can lose transitions for good; empty if the search ended early. */
    public List<Loss> losses() {
        return losses;
    }

    /** Whether {@code transition} can fire again after whatever happened before. */
    public Verdict live(Transition transition) {
        net().transition(transition.name());
        if (end != SearchEnd.COMPLETE) {
            return Verdict.UNKNOWN;
        }
        return losses.stream().anyMatch(loss -> loss.lost().contains(transition)) ? Verdict.NO : Verdict.YES;
    }

    /** Why the search ended; {@link SearchEnd#LIMIT} also if there are too many loops. */
    public SearchEnd end() {
        return end;
    }

    /** How many markings were visited. */
    public int visitedMarkings() {
        return visited.size();
    }

    /** How many firings were followed. */
    public int visitedEdges() {
        return visited.edgeCount();
    }

    /** How many markings were visited, and what is lost. */
    @Override
    public String toString() {
        var known = switch (end) {
            case COMPLETE ->
                losses.isEmpty() ? "all transitions are live" : losses.size() + " ways to lose transitions";
            case LIMIT -> "stopped at the limit";
            case MEMORY -> "out of memory";
            case CANCELLED -> "cancelled";
        };
        return net().name() + ": " + visitedMarkings() + " markings visited, " + known;
    }
}
