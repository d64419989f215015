package io.troupe.petri.structure;

import static java.util.Objects.requireNonNull;

/** What {@link EmptySiphonProgram} found out about all siphons of a net at once. */
public sealed interface EmptySiphonVerdict {
    /**
     * No siphon can be emptied, by the state equation: the program has no solution.
     *
     * <p>No more than the solver's word: it computes in floating point and leaves no proof behind. For an exact proof
     * see {@link SiphonVerdict.HoldsMarkedTrap} and {@link SiphonVerdict.HoldsTokens}.
     *
     * @param excludesDeadMarkings whether it follows that no reachable marking is dead; so it does if the net has
     *     transitions, and all their input arcs have weight 1
     */
    record NoneCanBeEmptied(boolean excludesDeadMarkings) implements EmptySiphonVerdict {}

    /**
     * A candidate only, to be confirmed by {@link SiphonAnalysis#confirm}: in some solution of the state equation, with
     * fractions of firings, it is empty. That it is a siphon was checked exactly.
     *
     * @param siphon a minimal one
     */
    record MayBeEmptied(PlaceSet siphon) implements EmptySiphonVerdict {
        public MayBeEmptied {
            requireNonNull(siphon, "siphon");
        }
    }

    /** Nothing is known, and why. */
    record Undecided(String reason) implements EmptySiphonVerdict {
        public Undecided {
            requireNonNull(reason, "reason");
        }
    }
}
