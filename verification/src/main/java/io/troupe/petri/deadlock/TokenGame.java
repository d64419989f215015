package io.troupe.petri.deadlock;

import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.SplittableRandom;
import java.util.stream.IntStream;
import java.util.stream.Stream;

/**
 * One marking of a net, changed by firing and by taking firings back. Which transitions are ready is kept up to date: a
 * firing costs only its arcs and those of the places that it changes.
 */
final class TokenGame {
    /** By place: the conditions on its tokens, as transition and threshold. */
    private record Conditions(int[] transitions, int[] thresholds) {}

    private static final int MAX_TOKENS = Integer.MAX_VALUE / 2;
    private static final long SEED = 0x5DEECE66DL;

    private final FlatNet net;
    private final boolean isPrioritised;
    private final int[] tokens;
    /** By transition: the places that a firing changes, and by how much. */
    private final int[][] changed;

    private final int[][] changes;
    /** By transition: what a firing adds to the fingerprint. */
    private final long[] fingerprintChanges;

    private final Conditions[] inputs;
    private final Conditions[] inhibitors;
    /** By transition: how many of its conditions are not met. */
    private final int[] unmet;

    /** The ready transitions, in no order, and where each of them stands. */
    private final int[] ready;

    private final int[] position;
    private int readyCount;
    private long fingerprint;

    TokenGame(FlatNet net) {
        this.net = net;
        isPrioritised = net.isPrioritised();
        tokens = net.tokens().clone();
        changed = new int[net.transitions()][];
        changes = new int[net.transitions()][];
        fingerprintChanges = new long[net.transitions()];
        inputs = conditions(net.inputs(), net.inputWeights());
        inhibitors = conditions(net.inhibitors(), net.inhibitorWeights());
        unmet = new int[net.transitions()];
        ready = new int[net.transitions()];
        position = new int[net.transitions()];
        var random = new SplittableRandom(SEED);
        var codes = random.longs(net.places()).toArray();
        var sums = new int[net.places()];
        for (var t = 0; t < net.transitions(); t++) {
            sumUp(t, sums, codes);
        }
        for (var p = 0; p < tokens.length; p++) {
            fingerprint += codes[p] * tokens[p];
        }
        Arrays.fill(position, -1);
        for (var t = 0; t < net.transitions(); t++) {
            unmet[t] = unmet(t);
            if (unmet[t] == 0) {
                setReady(t);
            }
        }
    }

    private void sumUp(int t, int[] sums, long[] codes) {
        var touched = new int[net.inputs()[t].length + net.outputs()[t].length];
        var count = 0;
        for (var i = 0; i < net.inputs()[t].length; i++) {
            sums[net.inputs()[t][i]] -= net.inputWeights()[t][i];
            touched[count++] = net.inputs()[t][i];
        }
        for (var i = 0; i < net.outputs()[t].length; i++) {
            sums[net.outputs()[t][i]] += net.outputWeights()[t][i];
            touched[count++] = net.outputs()[t][i];
        }
        var places = Arrays.stream(touched).distinct().filter(p -> sums[p] != 0).toArray();
        changed[t] = places;
        changes[t] = Arrays.stream(places).map(p -> sums[p]).toArray();
        for (var p : places) {
            fingerprintChanges[t] += codes[p] * sums[p];
        }
        for (var p : touched) {
            sums[p] = 0;
        }
    }

    private Conditions[] conditions(int[][] places, int[][] weights) {
        var counts = new int[net.places()];
        for (var row : places) {
            for (var p : row) {
                counts[p]++;
            }
        }
        var result = new Conditions[net.places()];
        for (var p = 0; p < result.length; p++) {
            result[p] = new Conditions(new int[counts[p]], new int[counts[p]]);
        }
        for (var t = 0; t < places.length; t++) {
            for (var i = 0; i < places[t].length; i++) {
                var p = places[t][i];
                counts[p]--;
                result[p].transitions[counts[p]] = t;
                result[p].thresholds[counts[p]] = weights[t][i];
            }
        }
        return result;
    }

    private int unmet(int t) {
        var count = 0;
        for (var i = 0; i < net.inputs()[t].length; i++) {
            count += tokens[net.inputs()[t][i]] < net.inputWeights()[t][i] ? 1 : 0;
        }
        for (var i = 0; i < net.inhibitors()[t].length; i++) {
            count += tokens[net.inhibitors()[t][i]] >= net.inhibitorWeights()[t][i] ? 1 : 0;
        }
        return count;
    }

    /** Equal for transitions with the same effect: the places that a firing changes, each with the change. */
    List<Integer> effect(int t) {
        return IntStream.range(0, changed[t].length)
                .boxed()
                .sorted(Comparator.comparingInt(i -> changed[t][i]))
                .flatMap(i -> Stream.of(changed[t][i], changes[t][i]))
                .toList();
    }

    /** Whether t has its tokens and is not inhibited; priorities are ignored. */
    boolean isReady(int t) {
        return unmet[t] == 0;
    }

    /** Whether t may fire. */
    boolean mayFire(int t) {
        return unmet[t] == 0 && (!isPrioritised || net.priorities()[t] == highestPriority());
    }

    private int highestPriority() {
        var highest = Integer.MIN_VALUE;
        for (var i = 0; i < readyCount; i++) {
            highest = Math.max(highest, net.priorities()[ready[i]]);
        }
        return highest;
    }

    boolean isDead() {
        return readyCount == 0;
    }

    /** How many transitions are ready; priorities are ignored. */
    int readyCount() {
        return readyCount;
    }

    /** Writes the transitions that may fire to {@code chosen}, in no order, and returns their number. */
    int enabled(int[] chosen) {
        if (!isPrioritised) {
            System.arraycopy(ready, 0, chosen, 0, readyCount);
            return readyCount;
        }
        var highest = highestPriority();
        var count = 0;
        for (var i = 0; i < readyCount; i++) {
            if (net.priorities()[ready[i]] == highest) {
                chosen[count++] = ready[i];
            }
        }
        return count;
    }

    /** Equal for equal markings; two others agree by chance once in 2^64. */
    long fingerprint() {
        return fingerprint;
    }

    long fingerprintAfter(int t) {
        return fingerprint + fingerprintChanges[t];
    }

    int[] tokens() {
        return tokens.clone();
    }

    /** Whether a place has so many tokens that a firing of t would leave the range of the counters. */
    boolean overflows(int t) {
        for (var i = 0; i < changed[t].length; i++) {
            if (changes[t][i] > 0 && tokens[changed[t][i]] > MAX_TOKENS - changes[t][i]) {
                return true;
            }
        }
        return false;
    }

    void fire(int t) {
        fingerprint += fingerprintChanges[t];
        for (var i = 0; i < changed[t].length; i++) {
            set(changed[t][i], tokens[changed[t][i]] + changes[t][i]);
        }
    }

    void takeBack(int t) {
        fingerprint -= fingerprintChanges[t];
        for (var i = 0; i < changed[t].length; i++) {
            set(changed[t][i], tokens[changed[t][i]] - changes[t][i]);
        }
    }

    private void set(int place, int now) {
        var before = tokens[place];
        tokens[place] = now;
        var needed = inputs[place];
        for (var i = 0; i < needed.transitions.length; i++) {
            var threshold = needed.thresholds[i];
            if (before < threshold != now < threshold) {
                count(needed.transitions[i], now < threshold ? 1 : -1);
            }
        }
        var inhibited = inhibitors[place];
        for (var i = 0; i < inhibited.transitions.length; i++) {
            var threshold = inhibited.thresholds[i];
            if (before >= threshold != now >= threshold) {
                count(inhibited.transitions[i], now >= threshold ? 1 : -1);
            }
        }
    }

    private void count(int t, int more) {
        unmet[t] += more;
        if (unmet[t] == 0) {
            setReady(t);
        } else if (position[t] >= 0) {
            var last = ready[--readyCount];
            ready[position[t]] = last;
            position[last] = position[t];
            position[t] = -1;
        }
    }

    private void setReady(int t) {
        position[t] = readyCount;
        ready[readyCount++] = t;
    }
}
