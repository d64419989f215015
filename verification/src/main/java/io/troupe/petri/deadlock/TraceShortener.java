package io.troupe.petri.deadlock;

import io.troupe.petri.PetriNet;
import io.troupe.petri.TokenGame;
import java.util.Arrays;
import java.util.HashMap;

/** Leaves firings out of a trace to a dead marking, as long as what is left leads to a dead marking too. */
final class TraceShortener {
    /** Enough for a trace of some thousand firings. */
    private static final long MAX_FIRINGS = 60_000_000;

    /** In a longer trace firings are not left out one by one: the limit would allow this for a few of them only. */
    private static final int MAX_LENGTH = 20_000;

    private final TokenGame game;
    private long firings;

    TraceShortener(PetriNet net) {
        game = new TokenGame(net);
    }

    /**
     * A trace that is at most as long. Unless it is very long, no single firing can be left out with what depends on
     * it.
     */
    int[] shorten(int[] trace) {
        var shorter = trace;
        for (var length = Integer.MAX_VALUE; shorter.length < length && firings < MAX_FIRINGS; ) {
            length = shorter.length;
            shorter = withoutLoops(shorter);
            shorter = shorter.length > MAX_LENGTH ? shorter : withoutOneByOne(shorter);
        }
        return shorter;
    }

    /** Leaves out the firings between two equal markings. */
    private int[] withoutLoops(int[] trace) {
        var kept = new int[trace.length];
        var seen = new HashMap<Long, Integer>();
        seen.put(game.fingerprint(), 0);
        var prints = new long[trace.length + 1];
        prints[0] = game.fingerprint();
        var length = 0;
        for (var t : trace) {
            game.fire(t);
            kept[length++] = t;
            var print = game.fingerprint();
            var before = seen.get(print);
            if (before != null && isLoop(kept, before, length)) {
                for (var i = before + 1; i < length; i++) {
                    seen.remove(prints[i]);
                }
                length = before;
            } else {
                seen.put(print, length);
                prints[length] = print;
            }
        }
        for (var i = trace.length - 1; i >= 0; i--) {
            game.takeBack(trace[i]);
        }
        return Arrays.copyOf(kept, length);
    }

    /** Whether these firings, the last ones, change nothing: two markings may have one fingerprint. */
    private boolean isLoop(int[] trace, int from, int to) {
        var now = game.tokens();
        for (var i = to - 1; i >= from; i--) {
            game.takeBack(trace[i]);
        }
        var before = game.tokens();
        for (var i = from; i < to; i++) {
            game.fire(trace[i]);
        }
        return Arrays.equals(before, now);
    }

    /** Tries for each firing, last first, to leave it out together with all that cannot fire without it. */
    private int[] withoutOneByOne(int[] trace) {
        var rest = trace;
        for (var t : rest) {
            game.fire(t);
        }
        for (var i = rest.length - 1; i >= 0; i--) {
            game.takeBack(rest[i]);
            if (firings < MAX_FIRINGS) {
                rest = without(i, rest);
            }
        }
        return rest;
    }

    /** Called in the marking before firing i. */
    private int[] without(int i, int[] trace) {
        var kept = new int[trace.length];
        System.arraycopy(trace, 0, kept, 0, i);
        var length = i;
        for (var j = i + 1; j < trace.length; j++) {
            if (game.mayFire(trace[j]) && !game.overflows(trace[j])) {
                game.fire(trace[j]);
                kept[length++] = trace[j];
            }
        }
        firings += trace.length - i;
        var isDead = game.isDead();
        for (var j = length - 1; j >= i; j--) {
            game.takeBack(kept[j]);
        }
        return isDead ? Arrays.copyOf(kept, length) : trace;
    }

    /** Whether the trace can fire and ends in a dead marking. */
    static boolean leadsToDeadMarking(PetriNet net, int[] trace) {
        var game = new TokenGame(net);
        for (var t : trace) {
            if (!game.mayFire(t) || game.overflows(t)) {
                return false;
            }
            game.fire(t);
        }
        return game.isDead();
    }
}
