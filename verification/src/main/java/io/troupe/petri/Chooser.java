package io.troupe.petri;

import java.util.Arrays;

/** Chooses the transitions that a search follows from a marking. */
interface Chooser {
    /** Follows all that may fire. */
    Chooser ALL = (game, chosen) -> {
        var count = game.enabled(chosen);
        Arrays.sort(chosen, 0, count);
        return count;
    };

    /**
     * Writes the transitions to follow into {@code chosen}, in order, and returns their number. The number is 0 only if
     * no transition may fire.
     */
    int choose(TokenGame game, int[] chosen);
}
