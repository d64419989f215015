package io.troupe.petri.wiring;

import io.troupe.petri.Place;
import io.troupe.petri.ReachabilityGraph;
import java.util.List;

/**
 * What a search saw.
 *
 * @param places of the net
 * @param transitions of the net
 * @param arcs of the net
 * @param markings that were visited
 * @param edges between these
 * @param deadMarkings among these
 * @param isComplete whether these are all reachable markings
 * @param neverReached the places that no visited marking marks, states of a component as {@code component.state}
 */
public record Figures(
        int places,
        int transitions,
        int arcs,
        int markings,
        int edges,
        int deadMarkings,
        boolean isComplete,
        List<String> neverReached) {
    public Figures {
        neverReached = List.copyOf(neverReached);
    }

    static Figures of(ReachabilityGraph graph) {
        var net = graph.net();
        return new Figures(
                net.places().size(),
                net.transitions().size(),
                net.arcCount(),
                graph.size(),
                graph.edgeCount(),
                graph.dead().size(),
                graph.isComplete(),
                graph.neverMarked().stream().map(Place::name).toList());
    }

    /** In one line. */
    @Override
    public String toString() {
        var text = places + " places, " + transitions + " transitions, " + arcs + " arcs; " + markings + " markings"
                + (isComplete ? "" : " (stopped at this limit)") + ", " + edges + " edges, " + deadMarkings + " dead";
        return neverReached.isEmpty() ? text : text + "; never reached: " + String.join(", ", neverReached);
    }
}
