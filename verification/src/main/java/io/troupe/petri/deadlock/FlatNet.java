package io.troupe.petri.deadlock;

import io.troupe.petri.Arc;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.Transition;
import java.util.Arrays;
import java.util.List;
import java.util.function.Function;

/**
 * A net as arrays. The first index is the transition; the second numbers its arcs.
 *
 * @param tokens by place: the tokens of the initial marking
 * @param inputs the input places
 * @param inputWeights the weights of these arcs
 * @param outputs the output places
 * @param outputWeights the weights of these arcs
 * @param inhibitors the places that inhibit the transition
 * @param inhibitorWeights the weights of these arcs
 * @param priorities by transition
 */
@SuppressWarnings("ArrayRecordComponent") // never compared, never changed
record FlatNet(
        int[] tokens,
        int[][] inputs,
        int[][] inputWeights,
        int[][] outputs,
        int[][] outputWeights,
        int[][] inhibitors,
        int[][] inhibitorWeights,
        int[] priorities) {

    static FlatNet of(PetriNet net) {
        return new FlatNet(
                net.places().stream().mapToInt(Place::tokens).toArray(),
                places(net, Transition::inputs),
                weights(net, Transition::inputs),
                places(net, Transition::outputs),
                weights(net, Transition::outputs),
                places(net, Transition::inhibitors),
                weights(net, Transition::inhibitors),
                net.transitions().stream().mapToInt(Transition::priority).toArray());
    }

    private static int[][] places(PetriNet net, Function<Transition, List<Arc>> arcs) {
        return net.transitions().stream()
                .map(t -> arcs.apply(t).stream()
                        .mapToInt(arc -> arc.place().index())
                        .toArray())
                .toArray(int[][]::new);
    }

    private static int[][] weights(PetriNet net, Function<Transition, List<Arc>> arcs) {
        return net.transitions().stream()
                .map(t -> arcs.apply(t).stream().mapToInt(Arc::weight).toArray())
                .toArray(int[][]::new);
    }

    int places() {
        return tokens.length;
    }

    int transitions() {
        return inputs.length;
    }

    boolean isPrioritised() {
        return Arrays.stream(priorities).distinct().count() > 1;
    }
}
