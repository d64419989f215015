package io.troupe.petri;

import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.SplittableRandom;
import java.util.stream.IntStream;
import java.util.stream.Stream;

/**
 * One marking of a net, changed by firing and by taking firings back. Which transitions are ready is kept up to date: a
 * firing costs only its arcs and those of the places that it changes. Places and transitions are named by their index.
 *
 * {@snippet :
 * var game = new TokenGame(net);
 * game.fire(net.transition("ask").index());
 * game.takeBack(net.transition("ask").index());
 * }
 *
 * <p><b>Role.</b> What all searches are made of.
 *
 * <p><b>Threads.</b> Not thread-safe.
 *
 * <p><b>Errors.</b> It checks nothing: fire what {@link #mayFire} allows and {@link #overflows} does not forbid, and
 * take back in the reverse order.
 */
public final class TokenGame {
    private static final long SEED = 0x5DEECE66DL;

    private final CompiledNet net;
    private final long[] tokens;
    /** By place: what one more token adds to the fingerprint. */
    private final long[] codes;
    /** By transition: what a firing adds to it. */
    private final long[] fingerprintChanges;

    /** By transition: how many of its conditions are not met. */
    private final int[] unmet;

    /** The ready transitions, in no order, and where each of them stands. */
    private final int[] ready;

    private final int[] position;
    private int readyCount;
    private long fingerprint;

    /** Starts in the initial marking. */
    public TokenGame(PetriNet net) {
        this.net = net.compiled();
        tokens = net.initialMarking().toArray();
        codes = new SplittableRandom(SEED).longs(tokens.length).toArray();
        var transitions = net.transitions().size();
        fingerprintChanges = new long[transitions];
        for (var t = 0; t < transitions; t++) {
            for (var i = 0; i < this.net.changed[t].length; i++) {
                fingerprintChanges[t] += codes[this.net.changed[t][i]] * this.net.changes[t][i];
            }
        }
        for (var place = 0; place < tokens.length; place++) {
            fingerprint += codes[place] * tokens[place];
        }
        unmet = new int[transitions];
        ready = new int[transitions];
        position = new int[transitions];
        Arrays.fill(position, -1);
        for (var t = 0; t < transitions; t++) {
            unmet[t] = this.net.unmet(tokens, t);
            if (unmet[t] == 0) {
                setReady(t);
            }
        }
    }

    /** Whether a transition has its tokens and is not inhibited; priorities are ignored. */
    public boolean isReady(int transition) {
        return unmet[transition] == 0;
    }

    /** Whether a transition may fire. */
    public boolean mayFire(int transition) {
        return unmet[transition] == 0 && (!net.isPrioritised || net.priorities[transition] == highestPriority());
    }

    private int highestPriority() {
        var highest = Integer.MIN_VALUE;
        for (var i = 0; i < readyCount; i++) {
            highest = Math.max(highest, net.priorities[ready[i]]);
        }
        return highest;
    }

    /** Whether no transition may fire. */
    public boolean isDead() {
        return readyCount == 0;
    }

    /** How many transitions are ready; priorities are ignored. */
    public int readyCount() {
        return readyCount;
    }

    /** Writes the transitions that may fire to {@code chosen}, in no order, and returns their number. */
    public int enabled(int[] chosen) {
        if (!net.isPrioritised) {
            System.arraycopy(ready, 0, chosen, 0, readyCount);
            return readyCount;
        }
        var highest = highestPriority();
        var count = 0;
        for (var i = 0; i < readyCount; i++) {
            if (net.priorities[ready[i]] == highest) {
                chosen[count++] = ready[i];
            }
        }
        return count;
    }

    /** Equal for transitions with the same effect: the places that a firing changes, each with the change. */
    public List<Integer> effect(int transition) {
        return IntStream.range(0, net.changed[transition].length)
                .boxed()
                .sorted(Comparator.comparingInt(i -> net.changed[transition][i]))
                .flatMap(i -> Stream.of(net.changed[transition][i], net.changes[transition][i]))
                .toList();
    }

    /** Equal for equal markings; two others agree by chance once in 2^64. */
    public long fingerprint() {
        return fingerprint;
    }

    /** The fingerprint after a firing. */
    public long fingerprintAfter(int transition) {
        return fingerprint + fingerprintChanges[transition];
    }

    /** The tokens on a place. */
    public long tokens(int place) {
        return tokens[place];
    }

    /** The tokens on all places. */
    public long[] tokens() {
        return tokens.clone();
    }

    /** Whether a firing would put more than {@link Long#MAX_VALUE} tokens on a place. */
    public boolean overflows(int transition) {
        var places = net.changed[transition];
        for (var i = 0; i < places.length; i++) {
            if (net.changes[transition][i] > 0 && tokens[places[i]] > Long.MAX_VALUE - net.changes[transition][i]) {
                return true;
            }
        }
        return false;
    }

    /** Fires a transition. */
    public void fire(int transition) {
        fingerprint += fingerprintChanges[transition];
        var places = net.changed[transition];
        for (var i = 0; i < places.length; i++) {
            set(places[i], tokens[places[i]] + net.changes[transition][i]);
        }
    }

    /** Takes the last firing back, that of this transition. */
    public void takeBack(int transition) {
        fingerprint -= fingerprintChanges[transition];
        var places = net.changed[transition];
        for (var i = 0; i < places.length; i++) {
            set(places[i], tokens[places[i]] - net.changes[transition][i]);
        }
    }

    /** Goes to any marking. */
    void moveTo(long[] marking) {
        for (var place = 0; place < tokens.length; place++) {
            if (tokens[place] != marking[place]) {
                fingerprint += codes[place] * (marking[place] - tokens[place]);
                set(place, marking[place]);
            }
        }
    }

    private void set(int place, long now) {
        var before = tokens[place];
        tokens[place] = now;
        var needed = net.needed[place];
        for (var i = 0; i < needed.transitions().length; i++) {
            var threshold = needed.thresholds()[i];
            if (before < threshold != now < threshold) {
                count(needed.transitions()[i], now < threshold ? 1 : -1);
            }
        }
        var inhibited = net.inhibited[place];
        for (var i = 0; i < inhibited.transitions().length; i++) {
            var threshold = inhibited.thresholds()[i];
            if (before >= threshold != now >= threshold) {
                count(inhibited.transitions()[i], now >= threshold ? 1 : -1);
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
