package io.troupe.petri;

import java.util.Arrays;
import java.util.List;
import java.util.stream.Stream;

/** A net as arrays, for whatever tests millions of times which transitions may fire. All index the same lists. */
final class CompiledNet {
    /** By transition: its input places, and the weights of these arcs. */
    final int[][] inputs;

    final int[][] inputWeights;
    /** By transition: the places whose tokens inhibit it, and from how many on. */
    final int[][] inhibitors;

    final int[][] inhibitorWeights;
    /** By transition: the places that a firing changes, and by how much. */
    final int[][] changed;

    final int[][] changes;
    /** By place: what its tokens enable and disable. */
    final Conditions[] needed;

    final Conditions[] inhibited;
    final int[] priorities;
    final boolean isPrioritised;

    /** The conditions of transitions on the tokens of one place: that these are at least, or below, a threshold. */
    @SuppressWarnings("ArrayRecordComponent") // never compared, never changed
    record Conditions(int[] transitions, int[] thresholds) {}

    CompiledNet(List<Place> places, List<Transition> transitions) {
        inputs = places(transitions.stream().map(Transition::inputs));
        inputWeights = weights(transitions.stream().map(Transition::inputs));
        inhibitors = places(transitions.stream().map(Transition::inhibitors));
        inhibitorWeights = weights(transitions.stream().map(Transition::inhibitors));
        priorities = transitions.stream().mapToInt(Transition::priority).toArray();
        isPrioritised = Arrays.stream(priorities).distinct().count() > 1;
        changed = new int[transitions.size()][];
        changes = new int[transitions.size()][];
        var sums = new int[places.size()];
        transitions.forEach(t -> sumUp(t, sums));
        needed = conditions(inputs, inputWeights, places.size());
        inhibited = conditions(inhibitors, inhibitorWeights, places.size());
    }

    private static int[][] places(Stream<List<Arc>> ofTransitions) {
        return ofTransitions
                .map(arcs -> arcs.stream().mapToInt(arc -> arc.place().index()).toArray())
                .toArray(int[][]::new);
    }

    private static int[][] weights(Stream<List<Arc>> ofTransitions) {
        return ofTransitions
                .map(arcs -> arcs.stream().mapToInt(Arc::weight).toArray())
                .toArray(int[][]::new);
    }

    private void sumUp(Transition t, int[] sums) {
        t.inputs().forEach(arc -> sums[arc.place().index()] -= arc.weight());
        t.outputs().forEach(arc -> sums[arc.place().index()] += arc.weight());
        var touched = Stream.concat(t.inputs().stream(), t.outputs().stream())
                .mapToInt(arc -> arc.place().index())
                .distinct()
                .toArray();
        changed[t.index()] =
                Arrays.stream(touched).filter(place -> sums[place] != 0).toArray();
        changes[t.index()] =
                Arrays.stream(changed[t.index()]).map(place -> sums[place]).toArray();
        Arrays.stream(touched).forEach(place -> sums[place] = 0);
    }

    private static Conditions[] conditions(int[][] places, int[][] weights, int size) {
        var counts = new int[size];
        Arrays.stream(places).flatMapToInt(Arrays::stream).forEach(place -> counts[place]++);
        var result = Arrays.stream(counts)
                .mapToObj(count -> new Conditions(new int[count], new int[count]))
                .toArray(Conditions[]::new);
        for (var t = 0; t < places.length; t++) {
            for (var i = 0; i < places[t].length; i++) {
                var place = places[t][i];
                counts[place]--;
                result[place].transitions[counts[place]] = t;
                result[place].thresholds[counts[place]] = weights[t][i];
            }
        }
        return result;
    }

    /** How many of the conditions of t are not met; priorities are ignored. */
    int unmet(long[] tokens, int t) {
        var count = 0;
        for (var i = 0; i < inputs[t].length; i++) {
            count += tokens[inputs[t][i]] < inputWeights[t][i] ? 1 : 0;
        }
        for (var i = 0; i < inhibitors[t].length; i++) {
            count += tokens[inhibitors[t][i]] >= inhibitorWeights[t][i] ? 1 : 0;
        }
        return count;
    }
}
