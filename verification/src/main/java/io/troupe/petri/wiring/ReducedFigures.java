package io.troupe.petri.wiring;

import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.ProgressSearch;
import io.troupe.petri.SearchEnd;

/**
 * What the search by stubborn sets saw, which visits a part of the markings and misses no dead one.
 *
 * @param markings that were visited
 * @param edges that were followed
 * @param deadMarkings among these
 * @param end why the search ended; {@link SearchEnd#COMPLETE} if no reachable marking is dead but these
 * @param showsBlocks whether these markings were also enough to tell if some component can be blocked while others go
 *     on
 */
public record ReducedFigures(int markings, int edges, int deadMarkings, SearchEnd end, boolean showsBlocks) {
    static ReducedFigures of(DeadlockSearch search) {
        return new ReducedFigures(
                search.visitedMarkings(),
                search.visitedEdges(),
                search.deadlocks().size(),
                search.end(),
                false);
    }

    /** Of a search of a wiring without dead markings. */
    static ReducedFigures of(ProgressSearch search) {
        return new ReducedFigures(search.visitedMarkings(), search.visitedEdges(), 0, search.end(), true);
    }

    /** Whether no dead marking is missing. */
    public boolean isComplete() {
        return end == SearchEnd.COMPLETE;
    }

    /** In one line. */
    @Override
    public String toString() {
        return markings + " markings by stubborn sets" + Figures.told(end) + ", " + deadMarkings + " dead"
                + (isComplete() ? " and no others" : " so far")
                + (showsBlocks ? ", enough to see blocks too" : "");
    }
}
