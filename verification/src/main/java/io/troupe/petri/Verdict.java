package io.troupe.petri;

/** The answer to a question about all reachable markings, when perhaps not all of them were visited. */
public enum Verdict {
    /** Proved. */
    YES,
    /** Refuted; there is a firing sequence that shows it. */
    NO,
    /** The search ended, at its limit or cancelled, before it could tell. */
    UNKNOWN
}
