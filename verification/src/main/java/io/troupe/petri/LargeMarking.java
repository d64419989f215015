package io.troupe.petri;

import java.util.Arrays;
import java.util.List;

/**
 * The number of tokens on each place of a {@link LargeNet}.
 *
 * <p><b>Threads.</b> Immutable.
 */
public final class LargeMarking {
    private final List<Place> places;
    private final long[] tokens;

    /** Creates a marking that owns {@code tokens}, without a copy. */
    LargeMarking(List<Place> places, long[] tokens) {
        this.places = places;
        this.tokens = tokens;
    }

    /** The number of tokens on a place. */
    public long tokens(Place place) {
        if (place.index() >= places.size() || !places.get(place.index()).equals(place)) {
            throw new IllegalArgumentException("place " + place + " is not of the net this marking belongs to");
        }
        return tokens[place.index()];
    }

    long[] toArray() {
        return tokens.clone();
    }

    void requirePlaces(PetriNet net) {
        if (!places.equals(net.places())) {
            throw new IllegalArgumentException("marking " + this + " is of a net with other places than " + net.name());
        }
    }

    @Override
    public boolean equals(Object other) {
        return other instanceof LargeMarking that && Arrays.equals(tokens, that.tokens) && places.equals(that.places);
    }

    @Override
    public int hashCode() {
        return Arrays.hashCode(tokens);
    }

    /** The marked places, for example <code>{P1, 4000000000*M4}</code>. */
    @Override
    public String toString() {
        return Marking.text(places, place -> tokens[place.index()]);
    }
}
