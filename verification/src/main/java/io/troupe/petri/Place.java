package io.troupe.petri;

import static java.util.Objects.requireNonNull;

/**
 * A place of one net.
 *
 * @param index its position in {@link PetriNet#places()}
 * @param name unique among the places and transitions of the net
 * @param tokens its tokens in the initial marking
 */
public record Place(int index, String name, long tokens) {
    public Place {
        requireNonNull(name, "name");
    }

    /** The name. */
    @Override
    public String toString() {
        return name;
    }
}
