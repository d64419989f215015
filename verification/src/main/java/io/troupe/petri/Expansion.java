package io.troupe.petri;

/** Which transitions a search follows from a marking. */
interface Expansion {
    /**
     * Writes into {@code chosen} the transitions to follow, in their order, and returns how many they are; none only if
     * nothing may fire.
     */
    int choose(int[] tokens, int[] chosen);
}
