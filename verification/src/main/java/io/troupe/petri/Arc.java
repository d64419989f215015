package io.troupe.petri;

import static java.util.Objects.requireNonNull;

/**
 * An arc between a place and a transition.
 *
 * @param weight the number of tokens that one firing moves; for an inhibitor arc, the number of tokens that disables
 *     the transition. 1 or more
 */
public record Arc(Place place, int weight) {
    public Arc {
        requireNonNull(place, "place");
    }
}
