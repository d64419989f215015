package io.troupe.petri.structure;

import io.troupe.petri.Arc;
import io.troupe.petri.PetriNet;
import java.util.List;
import java.util.Set;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

/**
 * Computes siphons and traps of a small net directly from the definition, by testing all sets of places; a set is a bit
 * mask.
 */
final class StructureOracle {
    private final PetriNet net;
    private final boolean traps;

    StructureOracle(PetriNet net, boolean traps) {
        this.net = net;
        this.traps = traps;
    }

    /** All sets of places but the empty one. */
    IntStream subsets() {
        return IntStream.range(1, 1 << net.places().size());
    }

    boolean isClosed(int set) {
        return net.transitions().stream().allMatch(t -> {
            var feeding = touches(traps ? t.inputs() : t.outputs(), set);
            var needed = touches(traps ? t.outputs() : t.inputs(), set);
            return !feeding || needed;
        });
    }

    private static boolean touches(List<Arc> arcs, int set) {
        return arcs.stream().anyMatch(arc -> (set >> arc.place().index() & 1) != 0);
    }

    Set<PlaceSet> minimal() {
        var closed = subsets().filter(this::isClosed).toArray();
        return IntStream.of(closed)
                .filter(set -> IntStream.of(closed).noneMatch(other -> other != set && (other & set) == other))
                .mapToObj(this::set)
                .collect(Collectors.toSet());
    }

    /** The union of all closed sets within this one. */
    PlaceSet largestIn(int set) {
        return set(subsets()
                .filter(part -> (part & set) == part && isClosed(part))
                .reduce(0, (one, other) -> one | other));
    }

    PlaceSet set(int mask) {
        return PlaceSet.of(
                net,
                net.places().stream()
                        .filter(place -> (mask >> place.index() & 1) != 0)
                        .toList());
    }
}
