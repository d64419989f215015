package io.troupe.petri;

import java.util.List;

/**
 * Finds all dead markings of a net and how to get there, without visiting all markings: where the order of firings does
 * not matter for what is dead in the end, it follows only one.
 *
 * <p><b>Role.</b> Made by {@link #run}; the quick way to the question that {@link ReachabilityGraph#dead} answers too.
 * It tells nothing of liveness, bounds or dead transitions.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Order.</b> Breadth first over the markings that are visited. Every way to a dead marking has a permutation that
 * is followed, so the first way that is found is a shortest one of all.
 *
 * <p><b>Cost.</b> As for {@link ReachabilityGraph} for each marking visited, without the memory for edges; never more
 * than all, and of components that mostly work on their own about as few as the square root of their number. A net with
 * priorities is searched in full.
 *
 * <p><b>Source.</b> A. Valmari, Stubborn sets for reduced state space generation, 1989.
 */
public final class DeadlockSearch {
    private final ReachabilityGraph visited;

    private DeadlockSearch(ReachabilityGraph visited) {
        this.visited = visited;
    }

    /** Searches up to {@link ReachabilityGraph#DEFAULT_MAX_MARKINGS} markings. */
    public static DeadlockSearch run(PetriNet net) {
        return run(net, SearchLimits.markings(ReachabilityGraph.DEFAULT_MAX_MARKINGS));
    }

    /**
     * Searches as far as {@code limits} allow.
     *
     * @throws ArithmeticException if a place can hold more than {@link Integer#MAX_VALUE} tokens
     */
    public static DeadlockSearch run(PetriNet net, SearchLimits limits) {
        return new DeadlockSearch(ReachabilityGraph.withoutEdges(net, new StubbornSets(net), limits));
    }

    /**
     * A dead marking.
     *
     * @param marking where nothing may fire
     * @param trace a shortest firing sequence from the initial marking
     */
    public record Deadlock(Marking marking, List<Transition> trace) {
        public Deadlock {
            trace = List.copyOf(trace);
        }
    }

    public PetriNet net() {
        return visited.net();
    }

    /**
     * All dead markings, that with the shortest trace first; if the search ended early, there may be more. Each is made
     * when the list is asked for it: there can be millions, and their traces are long.
     */
    public List<Deadlock> deadlocks() {
        var dead = visited.dead();
        return new OnDemand<>(
                dead.size(),
                i -> new Deadlock(dead.get(i).marking(), dead.get(i).shortestTrace()));
    }

    /** Whether no reachable marking is dead. */
    public Verdict deadlockFree() {
        return visited.deadlockFree();
    }

    /** Why the search ended; {@link SearchEnd#COMPLETE} means that no dead marking is missing. */
    public SearchEnd end() {
        return visited.end();
    }

    /** How many markings were visited. */
    public int visitedMarkings() {
        return visited.size();
    }

    /** How many firings were followed. */
    public int visitedEdges() {
        return visited.edgeCount();
    }

    /** In one or two lines what is known and, when the search ended early, what is not. */
    @Override
    public String toString() {
        var text = new StringBuilder(net().name()).append(": ");
        text.append(visitedMarkings()).append(" markings visited, ");
        var dead = deadlocks();
        text.append(dead.size()).append(" dead");
        switch (end()) {
            case COMPLETE -> text.append(", all of them");
            case LIMIT -> text.append(" so far; stopped at the limit");
            case MEMORY -> text.append(" so far; out of memory");
            case CANCELLED -> text.append(" so far; cancelled");
        }
        if (!dead.isEmpty()) {
            text.append("\n  the nearest ").append(dead.get(0).marking());
            text.append(" after ").append(Shortened.list(dead.get(0).trace()));
        }
        return text.toString();
    }
}
