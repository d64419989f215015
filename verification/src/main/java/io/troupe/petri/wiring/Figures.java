package io.troupe.petri.wiring;

import io.troupe.petri.PetriNet;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchEnd;
import java.util.List;

/**
 * The figures of a search of all markings.
 *
 * @param places of the net
 * @param transitions of the net
 * @param arcs of the net
 * @param markings the number of visited markings
 * @param edges the number of firings between these
 * @param deadMarkings the number of dead ones among these
 * @param end why the search ended; {@link SearchEnd#COMPLETE} if these are all reachable markings
 * @param neverReached the places that no visited marking marks; states of a component are written as
 *     {@code component.state}
 */
public record Figures(
        int places,
        int transitions,
        int arcs,
        int markings,
        int edges,
        int deadMarkings,
        SearchEnd end,
        List<String> neverReached) {
    public Figures {
        neverReached = List.copyOf(neverReached);
    }

    /** The figures of a graph of {@code net}, or of a net that differs from it in names only. */
    static Figures of(PetriNet net, ReachabilityGraph graph) {
        return new Figures(
                net.places().size(),
                net.transitions().size(),
                net.arcCount(),
                graph.size(),
                graph.edgeCount(),
                graph.dead().size(),
                graph.end(),
                graph.neverMarked().stream()
                        .map(place -> net.places().get(place.index()).name())
                        .toList());
    }

    /** Whether these are all reachable markings. */
    public boolean isComplete() {
        return end == SearchEnd.COMPLETE;
    }

    /** In one line. */
    @Override
    public String toString() {
        var text = places + " places, " + transitions + " transitions, " + arcs + " arcs; " + markings + " markings"
                + endNote(end) + ", " + edges + " edges, " + deadMarkings + " dead";
        if (neverReached.isEmpty()) {
            return text;
        }
        return text
                + (isComplete()
                        ? "; never reached: " + String.join(", ", neverReached)
                        : "; " + neverReached.size() + " places not reached so far");
    }

    static String endNote(SearchEnd end) {
        return switch (end) {
            case COMPLETE -> "";
            case LIMIT -> " (stopped at this limit)";
            case MEMORY -> " (out of memory)";
            case CANCELLED -> " (cancelled)";
        };
    }
}
