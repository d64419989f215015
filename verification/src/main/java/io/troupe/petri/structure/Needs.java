package io.troupe.petri.structure;

import io.troupe.petri.Arc;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import java.util.ArrayList;
import java.util.BitSet;
import java.util.List;
import java.util.function.BooleanSupplier;

/*
 * For every place the sets of places of which a siphon with this place must hold one: the inputs of each transition
 * that puts a token there. For traps the same with the arrows turned round.
 */
final class Needs {
    private final List<List<BitSet>> needs = new ArrayList<>();

    private final BooleanSupplier cancelled;

    private Needs(PetriNet net, boolean siphons, BooleanSupplier cancelled) {
        this.cancelled = cancelled;
        net.places().forEach(place -> needs.add(new ArrayList<>()));
        for (var t : net.transitions()) {
            requireTime();
            var helpers = places(siphons ? t.inputs() : t.outputs());
            places(siphons ? t.outputs() : t.inputs()).stream()
                    .filter(place -> !helpers.get(place))
                    .forEach(place -> add(needs.get(place), helpers));
        }
    }

    static Needs ofSiphons(PetriNet net) {
        return ofSiphons(net, () -> false);
    }

    /** Each of their methods throws {@link OutOfTime} once {@code cancelled} says so. */
    static Needs ofSiphons(PetriNet net, BooleanSupplier cancelled) {
        return new Needs(net, true, cancelled);
    }

    static Needs ofTraps(PetriNet net) {
        return ofTraps(net, () -> false);
    }

    /** Each of their methods throws {@link OutOfTime} once {@code cancelled} says so. */
    static Needs ofTraps(PetriNet net, BooleanSupplier cancelled) {
        return new Needs(net, false, cancelled);
    }

    /** Ends a search that was cancelled; caught where it began. */
    static final class OutOfTime extends RuntimeException {
        private static final long serialVersionUID = 1L;

        OutOfTime() {
            super("cancelled", null, false, false);
        }
    }

    void requireTime() {
        if (cancelled.getAsBoolean()) {
            throw new OutOfTime();
        }
    }

    /** Keeps only the strongest needs: one that contains another follows from it. */
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

    /** Takes from the set, until it is stable, every place with a need that nothing in the set meets. */
    void shrinkToLargest(BitSet set) {
        var changed = true;
        while (changed) {
            changed = false;
            requireTime();
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
