package io.troupe.petri;

import java.util.List;

/**
 * Places that stay marked for ever once all of them are: components that wait for each other without end, whatever the
 * rest of the net goes on doing.
 *
 * <p><b>Role.</b> From {@link Liveness#permanentBlocks}.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * @param places in the order of the net; no part of them is a block
 * @param markings how many reachable markings have all of them marked
 * @param nearest the one of these markings that is nearest to the initial one
 */
public record PermanentBlock(List<Place> places, int markings, ReachabilityGraph.State nearest) {
    public PermanentBlock {
        places = List.copyOf(places);
    }

    /** The places, how many markings have them, and how to get there. */
    @Override
    public String toString() {
        return places + " in " + markings + " markings, the nearest " + nearest + " after " + nearest.shortestTrace();
    }
}
