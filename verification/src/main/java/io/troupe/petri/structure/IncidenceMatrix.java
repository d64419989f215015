package io.troupe.petri.structure;

import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.Transition;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.IntToLongFunction;

/** The incidence matrix: by transition, the places whose tokens a firing changes, and by how many. */
final class IncidenceMatrix {
    private final List<Map<Integer, Long>> ofTransitions = new ArrayList<>();
    private final List<Map<Integer, Long>> onPlaces = new ArrayList<>();

    IncidenceMatrix(PetriNet net) {
        net.places().forEach(place -> onPlaces.add(new TreeMap<>()));
        for (var t : net.transitions()) {
            var effect = effect(t);
            ofTransitions.add(effect);
            effect.forEach((place, change) -> onPlaces.get(place).put(t.index(), change));
        }
    }

    private static Map<Integer, Long> effect(Transition transition) {
        var effect = new TreeMap<Integer, Long>();
        transition.inputs().forEach(arc -> effect.merge(arc.place().index(), -(long) arc.weight(), Long::sum));
        transition.outputs().forEach(arc -> effect.merge(arc.place().index(), (long) arc.weight(), Long::sum));
        effect.values().removeIf(change -> change == 0);
        return effect;
    }

    /** By transition: by place, the tokens that one firing adds. Places without a change are left out. */
    List<Map<Integer, Long>> ofTransitions() {
        return ofTransitions;
    }

    /** By place: by transition, the tokens that one firing adds. */
    List<Map<Integer, Long>> onPlaces() {
        return onPlaces;
    }

    /** The exact sum of factor times value. */
    static long sum(Map<Integer, Long> values, IntToLongFunction factor) {
        var sum = 0L;
        for (var entry : values.entrySet()) {
            sum = Math.addExact(sum, Math.multiplyExact(entry.getValue(), factor.applyAsLong(entry.getKey())));
        }
        return sum;
    }

    /** The exact sum of weight times tokens of the initial marking. */
    static long initialSum(PetriNet net, IntToLongFunction weight) {
        var sum = 0L;
        for (Place place : net.places()) {
            sum = Math.addExact(sum, Math.multiplyExact((long) place.tokens(), weight.applyAsLong(place.index())));
        }
        return sum;
    }
}
