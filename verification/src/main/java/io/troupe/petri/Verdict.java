package io.troupe.petri;

/** The answer to a question about all reachable markings, of which perhaps not all were visited. */
public enum Verdict {
    /** Proved. */
    YES,
    /** Refuted: a firing sequence shows it. */
    NO,
    /** Undecided: the search ended at a limit or was cancelled. */
    UNKNOWN
}
