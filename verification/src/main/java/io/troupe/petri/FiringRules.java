package io.troupe.petri;

import java.util.Arrays;
import java.util.List;

/** The transitions of a net as arrays, for searches that test millions of times which transitions may fire. */
final class FiringRules implements Expansion {
    /** By transition: its input places. */
    final int[][] inputs;
    /** By transition: the weight of the arc from each input place. */
    final int[][] inputWeights;

    /** By transition: the places whose tokens inhibit it. */
    final int[][] inhibitors;
    /** By transition: the tokens on each of these places from which on it is inhibited. */
    final int[][] inhibitorWeights;

    private final int[] priorities;
    private final boolean prioritised;

    FiringRules(PetriNet net) {
        var transitions = net.transitions();
        inputs = transitions.stream().map(t -> places(t.inputs())).toArray(int[][]::new);
        inputWeights = transitions.stream().map(t -> weights(t.inputs())).toArray(int[][]::new);
        inhibitors = transitions.stream().map(t -> places(t.inhibitors())).toArray(int[][]::new);
        inhibitorWeights =
                transitions.stream().map(t -> weights(t.inhibitors())).toArray(int[][]::new);
        priorities = transitions.stream().mapToInt(Transition::priority).toArray();
        prioritised = Arrays.stream(priorities).distinct().count() > 1;
    }

    private static int[] places(List<Arc> arcs) {
        return arcs.stream().mapToInt(arc -> arc.place().index()).toArray();
    }

    private static int[] weights(List<Arc> arcs) {
        return arcs.stream().mapToInt(Arc::weight).toArray();
    }

    boolean isPrioritised() {
        return prioritised;
    }

    /** Whether the input places of t hold enough tokens, and no place inhibits it; priorities are ignored. */
    boolean isReady(int[] tokens, int t) {
        var places = inputs[t];
        var weights = inputWeights[t];
        for (var i = 0; i < places.length; i++) {
            if (tokens[places[i]] < weights[i]) {
                return false;
            }
        }
        var inhibiting = inhibitors[t];
        for (var i = 0; i < inhibiting.length; i++) {
            if (tokens[inhibiting[i]] >= inhibitorWeights[t][i]) {
                return false;
            }
        }
        return true;
    }

    @Override
    public int choose(int[] tokens, int[] chosen) {
        var count = 0;
        var highest = Integer.MIN_VALUE;
        for (var t = 0; t < inputs.length; t++) {
            if (isReady(tokens, t)) {
                highest = Math.max(highest, priorities[t]);
                chosen[count++] = t;
            }
        }
        return prioritised ? keep(highest, chosen, count) : count;
    }

    private int keep(int priority, int[] chosen, int count) {
        var kept = 0;
        for (var i = 0; i < count; i++) {
            if (priorities[chosen[i]] == priority) {
                chosen[kept++] = chosen[i];
            }
        }
        return kept;
    }
}
