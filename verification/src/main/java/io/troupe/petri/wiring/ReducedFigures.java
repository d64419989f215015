package io.troupe.petri.wiring;

import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.SearchEnd;

/**
 * What the search by stubborn sets saw, which visits a part of the markings and misses no dead one.
 *
 * @param markings that were visited
 * @param edges that were followed
 * @param deadMarkings among these
 * @param end why the search ended; {@link SearchEnd#COMPLETE} if no reachable marking is dead but these
 */
public record ReducedFigures(int markings, int edges, int deadMarkings, SearchEnd end) {
    static ReducedFigures of(DeadlockSearch search) {
        return new ReducedFigures(
                search.visitedMarkings(),
                search.visitedEdges(),
                search.deadlocks().size(),
                search.end());
    }

    /** Whether no dead marking is missing. */
    public boolean isComplete() {
        return end == SearchEnd.COMPLETE;
    }

    /** In one line. */
    @Override
    public String toString() {
        return markings + " markings by stubborn sets" + Figures.told(end) + ", " + deadMarkings + " dead"
                + (isComplete() ? " and no others" : " so far");
    }
}
