package io.troupe.petri;

import static java.util.Objects.requireNonNull;

/**
 * An arc between a place and a transition, with the number of tokens that one firing moves.
 *
 * @param weight 1 or more
 */
public record Arc(Place place, int weight) {
    public Arc {
        requireNonNull(place, "place");
    }
}
