package io.troupe.petri.wiring;

import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.ProgressSearch;
import io.troupe.petri.SearchEnd;

/**
 * The figures of a search by stubborn sets, which visits some of the markings and misses no dead one.
 *
 * @param markings the number of visited markings
 * @param edges the number of firings that were followed
 * @param deadMarkings the number of dead ones among these
 * @param end why the search ended; {@link SearchEnd#COMPLETE} if there are no other dead markings
 * @param showsBlocks whether these markings also decide if a component can be blocked while others go on
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

    /** The figures of a search of a wiring without dead markings. */
    static ReducedFigures of(ProgressSearch search) {
        return new ReducedFigures(search.visitedMarkings(), search.visitedEdges(), 0, search.end(), true);
    }

    /** Whether all dead markings were found. */
    public boolean isComplete() {
        return end == SearchEnd.COMPLETE;
    }

    /** In one line. */
    @Override
    public String toString() {
        return markings + " markings by stubborn sets" + Figures.endNote(end) + ", " + deadMarkings + " dead"
                + (isComplete() ? " and no others" : " so far")
                + (showsBlocks ? ", enough to see blocks too" : "");
    }
}
