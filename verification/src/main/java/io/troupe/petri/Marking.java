package io.troupe.petri;

import java.util.Arrays;
import java.util.List;
import java.util.stream.Collectors;

/**
 * The number of tokens on each place of a net.
 *
 * <p><b>Role.</b> Made by {@link PetriNet#marking}, by firing, or read from a {@link ReachabilityGraph}. Two markings
 * are equal when their places and tokens are equal, so nets that differ only in their transitions share markings.
 *
 * <p><b>Threads.</b> Immutable.
 */
public final class Marking {
    private final List<Place> places;
    private final long[] tokens;

    /** Creates a marking that owns {@code tokens}, without a copy. */
    Marking(List<Place> places, long[] tokens) {
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

    /** The places that hold a token, in the order of the net. */
    public List<Place> marked() {
        return places.stream().filter(place -> tokens[place.index()] > 0).toList();
    }

    /** Whether every place holds at least as many tokens as in {@code part}. */
    public boolean covers(Marking part) {
        part.requirePlaces(places, "the marking that covers it");
        for (var i = 0; i < tokens.length; i++) {
            if (tokens[i] < part.tokens[i]) {
                return false;
            }
        }
        return true;
    }

    long[] toArray() {
        return tokens.clone();
    }

    void requirePlaces(List<Place> expected, String owner) {
        if (places != expected && !places.equals(expected)) {
            throw new IllegalArgumentException("marking " + this + " is of a net with other places than " + owner);
        }
    }

    @Override
    public boolean equals(Object other) {
        return other instanceof Marking that && Arrays.equals(tokens, that.tokens) && places.equals(that.places);
    }

    @Override
    public int hashCode() {
        return Arrays.hashCode(tokens);
    }

    /** The marked places, for example <code>{P1, 2*M4}</code>. */
    @Override
    public String toString() {
        return places.stream()
                .filter(place -> tokens[place.index()] > 0)
                .map(place -> (tokens[place.index()] > 1 ? tokens[place.index()] + "*" : "") + place)
                .collect(Collectors.joining(", ", "{", "}"));
    }
}
