package io.troupe.petri.wiring;

import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.ProgressSearch;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchEnd;
import io.troupe.petri.Symmetry;
import io.troupe.petri.deadlock.DeadlockCheck;

/**
 * The figures of a search that visits some of the markings: by stubborn sets, which miss no dead one; or, for a large
 * net, those of {@link DeadlockCheck}, or of one marking of each orbit of equal components.
 *
 * @param method how these markings were chosen
 * @param markings the number of visited markings
 * @param edges the number of firings that were followed
 * @param deadMarkings the number of dead ones among these
 * @param end why the search ended; {@link SearchEnd#COMPLETE} if there are no other dead markings
 * @param showsBlocks whether these markings also decide if a component can be blocked while others go on
 */
public record ReducedFigures(
        String method, int markings, int edges, int deadMarkings, SearchEnd end, boolean showsBlocks) {
    private static final String STUBBORN_SETS = "stubborn sets";

    static ReducedFigures of(DeadlockSearch search) {
        return new ReducedFigures(
                STUBBORN_SETS,
                search.visitedMarkings(),
                search.visitedEdges(),
                search.deadlocks().size(),
                search.end(),
                false);
    }

    /** The figures of a search of a wiring without dead markings. */
    static ReducedFigures of(ProgressSearch search) {
        return new ReducedFigures(
                STUBBORN_SETS, search.visitedMarkings(), search.visitedEdges(), 0, search.end(), true);
    }

    /** The figures of a search of a wiring without dead markings by orbits of markings. */
    static ReducedFigures of(ReachabilityGraph graph, Symmetry symmetry) {
        return new ReducedFigures(
                "orbits of " + symmetry, graph.size(), graph.edgeCount(), 0, SearchEnd.COMPLETE, true);
    }

    /** The figures of a proof that there are no dead markings. */
    static ReducedFigures ofProof(int markings) {
        return new ReducedFigures("reductions", markings, 0, 0, SearchEnd.COMPLETE, false);
    }

    /** The figures of a counterexample: its own markings. */
    static ReducedFigures of(DeadlockSearch.Deadlock found) {
        var steps = found.trace().size();
        return new ReducedFigures("a hunt", steps + 1, steps, 1, SearchEnd.LIMIT, false);
    }

    /** Whether all dead markings were found. */
    public boolean isComplete() {
        return end == SearchEnd.COMPLETE;
    }

    /** In one line. */
    @Override
    public String toString() {
        return markings + " markings by " + method + Figures.endNote(end) + ", " + deadMarkings + " dead"
                + (isComplete() ? " and no others" : " so far")
                + (showsBlocks ? ", enough to see blocks too" : "");
    }
}
