package io.troupe.petri.structure;

import io.troupe.petri.PetriNet;
import io.troupe.petri.Transition;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

/** The incidence matrix: by transition, the places whose tokens a firing changes, and by how many. */
final class IncidenceMatrix {
    private IncidenceMatrix() {}

    /** By transition: by place, the tokens that one firing adds. Places without a change are left out. */
    static List<Map<Integer, Long>> of(PetriNet net) {
        return net.transitions().stream().map(IncidenceMatrix::effect).toList();
    }

    private static Map<Integer, Long> effect(Transition transition) {
        var effect = new TreeMap<Integer, Long>();
        transition.inputs().forEach(arc -> effect.merge(arc.place().index(), -(long) arc.weight(), Long::sum));
        transition.outputs().forEach(arc -> effect.merge(arc.place().index(), (long) arc.weight(), Long::sum));
        effect.values().removeIf(change -> change == 0);
        return effect;
    }
}
