package io.troupe.petri.structure;

import io.troupe.petri.Arc;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import java.util.ArrayList;
import java.util.BitSet;
import java.util.List;
import java.util.function.BooleanSupplier;

/**
 * The conditions for a siphon, by place. Each need is a set of places, of which a siphon with this place must contain
 * one: the inputs of a transition that puts a token on the place. For traps the arcs are reversed.
 */
final class Needs {
    private final List<List<BitSet>> needs = new ArrayList<>();

    private final BooleanSupplier cancelled;

    private Needs(PetriNet net, boolean siphons, BooleanSupplier cancelled) {
        this.cancelled = cancelled;
        net.places().forEach(place -> needs.add(new ArrayList<>()));
        for (var t : net.transitions()) {
            requireNotCancelled();
            var helpers = places(siphons ? t.inputs() : t.outputs());
            places(siphons ? t.outputs() : t.inputs()).stream()
                    .filter(place -> !helpers.get(place))
                    .forEach(place -> add(needs.get(place), helpers));
        }
    }

    /** The needs of siphons. Every method throws {@link Cancelled} once {@code cancelled} is true. */
    static Needs ofSiphons(PetriNet net, BooleanSupplier cancelled) {
        return new Needs(net, true, cancelled);
    }

    /** The needs of traps. Every method throws {@link Cancelled} once {@code cancelled} is true. */
    static Needs ofTraps(PetriNet net, BooleanSupplier cancelled) {
        return new Needs(net, false, cancelled);
    }

    /** Ends a cancelled search; it is caught where the search began. */
    static final class Cancelled extends RuntimeException {
        private static final long serialVersionUID = 1L;

        Cancelled() {
            super("cancelled", null, false, false);
        }
    }

    void requireNotCancelled() {
        if (cancelled.getAsBoolean()) {
            throw new Cancelled();
        }
    }

    /** Adds a need, and keeps only the strongest ones: a need that contains another follows from it. */
    private static void add(List<BitSet> known, BitSet need) {
        if (known.stream().noneMatch(other -> isSubset(other, need))) {
            known.removeIf(other -> isSubset(need, other));
            known.add(need);
        }
    }

    List<BitSet> of(int place) {
        return needs.get(place);
    }

    int places() {
        return needs.size();
    }

    /** Removes the places with an unmet need from the set, until none is left. */
    void shrinkToLargest(BitSet set) {
        var changed = true;
        while (changed) {
            changed = false;
            requireNotCancelled();
            for (var place = set.nextSetBit(0); place >= 0; place = set.nextSetBit(place + 1)) {
                if (!isMet(place, set)) {
                    set.clear(place);
                    changed = true;
                }
            }
        }
    }

    boolean isClosed(BitSet set) {
        return set.stream().allMatch(place -> isMet(place, set));
    }

    private boolean isMet(int place, BitSet set) {
        for (var need : needs.get(place)) {
            if (!need.intersects(set)) {
                return false;
            }
        }
        return true;
    }

    static boolean isSubset(BitSet part, BitSet whole) {
        for (var i = part.nextSetBit(0); i >= 0; i = part.nextSetBit(i + 1)) {
            if (!whole.get(i)) {
                return false;
            }
        }
        return true;
    }

    private static BitSet places(List<Arc> arcs) {
        var places = new BitSet();
        arcs.stream().map(Arc::place).mapToInt(Place::index).forEach(places::set);
        return places;
    }
}
