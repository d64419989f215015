package io.troupe.petri.structure;

import java.util.List;

/**
 * Minimal siphons or traps of a net: those that contain no smaller one.
 *
 * <p><b>Order.</b> Smaller sets first, then by their places in the order of the net.
 *
 * @param sets each is minimal, even if the search ended early
 * @param isComplete whether these are all; if not, the search reached its limit or was cancelled, and there may be more
 */
public record MinimalSets(List<PlaceSet> sets, boolean isComplete) {
    public MinimalSets {
        sets = List.copyOf(sets);
    }
}
