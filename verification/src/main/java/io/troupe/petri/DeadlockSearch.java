package io.troupe.petri;

import java.util.List;

/**
 * Finds all dead markings of a net and a shortest trace to each, without visiting all markings. Where the order of
 * firings has no effect on which markings are dead, only one order is followed.
 *
 * <p><b>Role.</b> Made by {@link #run}; the faster way to the answer of {@link ReachabilityGraph#dead}. It decides
 * neither liveness nor bounds nor dead transitions.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Order.</b> Breadth first over the visited markings. Every firing sequence to a dead marking has a permutation
 * that is followed, so the first trace found is a shortest one.
 *
 * <p><b>Cost.</b> As for {@link ReachabilityGraph} for each visited marking, without the memory for edges. It never
 * visits more than all markings; if the components are mostly independent, it visits about the square root of their
 * number. A net with priorities is searched in full.
 *
 * <p>With a {@link Symmetry} the search keeps one marking of each orbit. Both reductions go together: the stubborn set
 * of a marking leads on to each dead marking that can be reached from it, and from the marking that stands for the
 * orbit of the next one, an equal dead marking is as near.
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
     * Searches within {@code limits}.
     *
     * @throws ArithmeticException if a place can hold more than {@link Long#MAX_VALUE} tokens
     */
    public static DeadlockSearch run(PetriNet net, SearchLimits limits) {
        return run(net, Symmetry.none(net), limits);
    }

    /**
     * Searches within {@code limits} for one dead marking of each orbit of {@code symmetry}; {@link #visitedMarkings}
     * and {@link #visitedEdges} are those of orbits.
     *
     * @throws ArithmeticException if a place can hold more than {@link Long#MAX_VALUE} tokens
     */
    public static DeadlockSearch run(PetriNet net, Symmetry symmetry, SearchLimits limits) {
        return new DeadlockSearch(ReachabilityGraph.withoutEdges(net, new StubbornSets(net), symmetry, limits));
    }

    /**
     * Searches for any dead marking within {@code limits}, depth first. It is often found sooner than by {@link #run},
     * but its trace is not always a shortest one. The question is whether no reachable marking is dead.
     *
     * @throws ArithmeticException if a place can hold more than {@link Long#MAX_VALUE} tokens
     */
    public static Answer<Deadlock> first(PetriNet net, SearchLimits limits) {
        return first(net, Symmetry.none(net), limits);
    }

    /** Searches as {@link #first(PetriNet, SearchLimits)} does, with one marking of each orbit of {@code symmetry}. */
    public static Answer<Deadlock> first(PetriNet net, Symmetry symmetry, SearchLimits limits) {
        var visited = ReachabilityGraph.toFirstDead(net, new StubbornSets(net), symmetry, limits);
        return new DeadlockSearch(visited).answer();
    }

    /**
     * A dead marking.
     *
     * @param marking the marking, in which no transition may fire
     * @param trace a firing sequence from the initial marking; a shortest one, except from {@link #first}
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
     * All dead markings, the one with the shortest trace first; if the search ended early, there may be more. The list
     * computes each element on access, because there can be millions with long traces.
     */
    public List<Deadlock> deadlocks() {
        var dead = visited.dead();
        return new ComputedList<>(
                dead.size(),
                i -> new Deadlock(dead.get(i).marking(), dead.get(i).shortestTrace()));
    }

    /** Whether no reachable marking is dead; a no has the nearest one. */
    public Answer<Deadlock> answer() {
        var dead = deadlocks();
        if (!dead.isEmpty()) {
            return new Answer.No<>(dead.getFirst());
        }
        var symmetry = visited.symmetry();
        return end() == SearchEnd.COMPLETE
                ? new Answer.Yes<>(
                        (symmetry.isTrivial() ? "all markings" : "all orbits of markings (" + symmetry + ")")
                                + " by stubborn sets",
                        visitedMarkings())
                : new Answer.Unknown<>(end(), visitedMarkings());
    }

    /** Whether no reachable marking is dead. */
    public Verdict deadlockFree() {
        return visited.deadlockFree();
    }

    /** Why the search ended. {@link SearchEnd#COMPLETE} means that all dead markings were found. */
    public SearchEnd end() {
        return visited.end();
    }

    /** How many markings were visited. */
    public int visitedMarkings() {
        return visited.size();
    }

    /** The bytes that a visited marking itself takes. */
    public int bytesPerMarking() {
        return visited.bytesPerMarking();
    }

    /** How many firings were followed. */
    public int visitedEdges() {
        return visited.edgeCount();
    }

    /** In one or two lines: the result and, if the search ended early, what is not known. */
    @Override
    public String toString() {
        var text = new StringBuilder(net().name()).append(": ");
        var symmetry = visited.symmetry();
        text.append(visitedMarkings())
                .append(symmetry.isTrivial() ? " markings" : " orbits of markings (" + symmetry + ")")
                .append(" visited, ");
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
