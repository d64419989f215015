package io.troupe.petri.structure;

import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.function.BooleanSupplier;
import java.util.function.Supplier;

/**
 * Siphons and traps of a net.
 *
 * <p>A siphon is a set of places such that every transition that puts a token into it also takes one from it: once
 * empty, it stays empty. A trap is the reverse: every transition that takes a token from it also puts one into it, so
 * once marked, it stays marked. Both are properties of the arcs alone, for any weights and priorities. The empty set is
 * both, and is never reported.
 *
 * <p><b>Threads.</b> Thread-safe.
 *
 * <p><b>Cost.</b> The largest siphon or trap in a set takes time in proportion to arcs x places. There can be
 * exponentially many minimal ones.
 *
 * <p><b>Source.</b> The search splits as in Cordone, Ferrarini and Piroddi, Enumeration algorithms for minimal siphons
 * in Petri nets based on place constraints (2005).
 */
public final class Siphons {
    /** The limit of {@link #minimalSiphons(PetriNet)} and {@link #minimalTraps(PetriNet)}. */
    public static final long DEFAULT_MAX_STEPS = 1_000_000;

    private Siphons() {}

    /** Finds all minimal siphons in up to {@link #DEFAULT_MAX_STEPS} steps. */
    public static MinimalSets minimalSiphons(PetriNet net) {
        return minimalSiphons(net, DEFAULT_MAX_STEPS);
    }

    /** Finds all minimal siphons; each step (of {@code maxSteps}, 1 or more) finds at most one. */
    public static MinimalSets minimalSiphons(PetriNet net, long maxSteps) {
        return minimalSiphons(net, maxSteps, () -> false);
    }

    /**
     * Finds all minimal siphons in up to {@code maxSteps} (1 or more) steps, or until {@code cancelled} is true. It is
     * called often in each step, on the calling thread; to limit the time, let it compare a clock.
     */
    public static MinimalSets minimalSiphons(PetriNet net, long maxSteps, BooleanSupplier cancelled) {
        return minimal(net, () -> Needs.ofSiphons(net, cancelled), maxSteps);
    }

    /** Finds all minimal traps in up to {@link #DEFAULT_MAX_STEPS} steps. */
    public static MinimalSets minimalTraps(PetriNet net) {
        return minimalTraps(net, DEFAULT_MAX_STEPS);
    }

    /** Finds all minimal traps; each step (of {@code maxSteps}, 1 or more) finds at most one. */
    public static MinimalSets minimalTraps(PetriNet net, long maxSteps) {
        return minimalTraps(net, maxSteps, () -> false);
    }

    /** Finds all minimal traps, within the same limits as {@link #minimalSiphons(PetriNet, long, BooleanSupplier)}. */
    public static MinimalSets minimalTraps(PetriNet net, long maxSteps, BooleanSupplier cancelled) {
        return minimal(net, () -> Needs.ofTraps(net, cancelled), maxSteps);
    }

    public static boolean isSiphon(PlaceSet set) {
        return Needs.ofSiphons(set.net(), () -> false).isClosed(set.bits());
    }

    public static boolean isTrap(PlaceSet set) {
        return Needs.ofTraps(set.net(), () -> false).isClosed(set.bits());
    }

    /** The siphon within {@code set} that contains all others there; may be empty. */
    public static PlaceSet largestSiphonIn(PlaceSet set) {
        return largest(Needs.ofSiphons(set.net(), () -> false), set);
    }

    /** The trap within {@code set} that contains all others there; may be empty. */
    public static PlaceSet largestTrapIn(PlaceSet set) {
        return largest(Needs.ofTraps(set.net(), () -> false), set);
    }

    private static PlaceSet largest(Needs needs, PlaceSet set) {
        var largest = set.bits();
        needs.shrinkToLargest(largest);
        return new PlaceSet(set.net(), largest);
    }

    private static MinimalSets minimal(PetriNet net, Supplier<Needs> made, long maxSteps) {
        if (maxSteps < 1) {
            throw new IllegalArgumentException("maxSteps is " + maxSteps + ", expected 1 or more");
        }
        Needs needs;
        try {
            needs = made.get();
        } catch (Needs.Cancelled end) {
            return new MinimalSets(List.of(), false);
        }
        var search = new MinimalSetSearch(needs);
        var complete = search.run(maxSteps);
        var sets = search.found().stream()
                .map(set -> new PlaceSet(net, set))
                .sorted(Comparator.comparingInt(PlaceSet::size).thenComparing(Siphons::indices, Arrays::compare))
                .toList();
        return new MinimalSets(sets, complete);
    }

    private static int[] indices(PlaceSet set) {
        return set.places().stream().mapToInt(Place::index).toArray();
    }
}
