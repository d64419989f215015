package io.troupe.petri;

/** Why a search over markings ended. */
public enum SearchEnd {
    /** There is nothing more to find. */
    COMPLETE,
    /** There are more markings than it may keep. */
    LIMIT,
    /** It was told to end. */
    CANCELLED
}
