package io.troupe.petri.structure;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.Marking;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import java.util.BitSet;
import java.util.Collection;
import java.util.List;

/**
 * A set of places of one net.
 *
 * <p><b>Role.</b> Result and argument of {@link Siphons}. Equal when the members and the places of the net are equal.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Errors.</b> A place of another net throws {@link IllegalArgumentException}.
 */
public final class PlaceSet {
    private final PetriNet net;
    private final BitSet members;

    /** Creates a set that owns {@code members}, without a copy. */
    PlaceSet(PetriNet net, BitSet members) {
        this.net = net;
        this.members = members;
    }

    /** The set of these places. */
    public static PlaceSet of(PetriNet net, Collection<Place> places) {
        var members = new BitSet();
        for (var place : places) {
            if (place.index() >= net.places().size()
                    || !net.places().get(place.index()).equals(place)) {
                throw new IllegalArgumentException("place " + place + " is not of net " + net.name());
            }
            members.set(place.index());
        }
        return new PlaceSet(net, members);
    }

    /** The set of the places with these names. */
    public static PlaceSet of(PetriNet net, String... placeNames) {
        return of(net, List.of(placeNames).stream().map(net::place).toList());
    }

    public PetriNet net() {
        return net;
    }

    /** The members in the order of the net. */
    public List<Place> places() {
        return members.stream().mapToObj(net.places()::get).toList();
    }

    public int size() {
        return members.cardinality();
    }

    public boolean isEmpty() {
        return members.isEmpty();
    }

    public boolean contains(Place place) {
        return members.get(place.index()) && net.places().get(place.index()).equals(place);
    }

    /** Whether all members of the other set are members of this one; both sets must be of the same net. */
    public boolean containsAll(PlaceSet other) {
        requirePlacesOf(other.net);
        var missing = other.bits();
        missing.andNot(members);
        return missing.isEmpty();
    }

    /** The sum of the tokens on the members. */
    public long tokens(Marking marking) {
        return places().stream().mapToLong(marking::tokens).sum();
    }

    /** Whether a member holds a token. */
    public boolean isMarked(Marking marking) {
        return places().stream().anyMatch(place -> marking.tokens(place) > 0);
    }

    boolean has(int place) {
        return members.get(place);
    }

    BitSet bits() {
        return (BitSet) members.clone();
    }

    void requirePlacesOf(PetriNet other) {
        if (net != requireNonNull(other, "net") && !net.places().equals(other.places())) {
            throw new IllegalArgumentException(
                    "the set " + this + " is of net " + net.name() + ", whose places are not those of " + other.name());
        }
    }

    @Override
    public boolean equals(Object other) {
        return other instanceof PlaceSet that
                && members.equals(that.members)
                && net.places().equals(that.net.places());
    }

    @Override
    public int hashCode() {
        return members.hashCode();
    }

    /** The members, for example <code>{P1, M4}</code>. */
    @Override
    public String toString() {
        return places().toString().replace('[', '{').replace(']', '}');
    }
}
