package io.troupe.petri;

/** The reason why a search over markings ended. */
public enum SearchEnd {
    /** Everything was searched. */
    COMPLETE,
    /** The limit on the number of markings was reached. */
    LIMIT,
    /** Out of memory: the memory limit was reached, or the virtual machine has none left. */
    MEMORY,
    /** The search was cancelled. */
    CANCELLED
}
