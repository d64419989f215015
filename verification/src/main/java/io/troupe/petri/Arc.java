package io.troupe.petri;

import static java.util.Objects.requireNonNull;

/**
 * One end of a transition: the place, and how many tokens go through at each firing.
 *
 * @param weight 1 or more
 */
public record Arc(Place place, int weight) {
    public Arc {
        requireNonNull(place, "place");
    }
}
