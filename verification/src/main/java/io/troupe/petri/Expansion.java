package io.troupe.petri;

/** Chooses the transitions that a search follows from a marking. */
interface Expansion {
    /**
     * Writes the transitions to follow into {@code chosen}, in order, and returns their number. The number is 0 only if
     * no transition may fire.
     */
    int choose(int[] tokens, int[] chosen);
}
