package io.troupe.petri;

import java.util.List;

/**
 * Places that stay marked for ever once all of them are marked: components that wait for each other without end,
 * whatever the rest of the net does.
 *
 * <p><b>Role.</b> From {@link Liveness#permanentBlocks}.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * @param places in the order of the net; no proper subset is a block
 * @param markings how many reachable markings mark all of the places
 * @param nearest the one of these markings that is nearest to the initial marking
 */
public record PermanentBlock(List<Place> places, int markings, ReachabilityGraph.State nearest) {
    public PermanentBlock {
        places = List.copyOf(places);
    }

    /** The places, the number of markings that have them, and a trace to the nearest. */
    @Override
    public String toString() {
        return places + " in " + markings + " markings, the nearest " + nearest + " after " + nearest.shortestTrace();
    }
}
