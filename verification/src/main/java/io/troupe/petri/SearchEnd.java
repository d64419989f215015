package io.troupe.petri;

/** Why a search over markings ended. */
public enum SearchEnd {
    /** There is nothing more to find. */
    COMPLETE,
    /** There are more markings than it may keep. */
    LIMIT,
    /** There is no memory for more markings, by its limit or because the virtual machine has none. */
    MEMORY,
    /** It was told to end. */
    CANCELLED
}
