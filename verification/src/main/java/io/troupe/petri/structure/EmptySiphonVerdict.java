package io.troupe.petri.structure;

import static java.util.Objects.requireNonNull;

/** The result of {@link EmptySiphonProgram} for all siphons of a net at once. */
public sealed interface EmptySiphonVerdict {
    /**
     * No siphon can be emptied, by the state equation: the program has no solution.
     *
     * <p>This relies on the solver, which computes in floating point and gives no proof. For an exact proof see
     * {@link SiphonVerdict.HoldsMarkedTrap} and {@link SiphonVerdict.HoldsTokens}.
     *
     * @param excludesDeadMarkings whether no reachable marking is dead as a consequence; true if the net has
     *     transitions, all their input arcs have weight 1, and there are no inhibitor arcs
     */
    record NoneCanBeEmptied(boolean excludesDeadMarkings) implements EmptySiphonVerdict {}

    /**
     * A candidate, to be confirmed by {@link SiphonAnalysis#confirm}: the siphon is empty in some solution of the state
     * equation, with fractions of firings. That it is a siphon was checked exactly.
     *
     * @param siphon a minimal one
     */
    record MayBeEmptied(PlaceSet siphon) implements EmptySiphonVerdict {
        public MayBeEmptied {
            requireNonNull(siphon, "siphon");
        }
    }

    /** Undecided, with the reason. */
    record Undecided(String reason) implements EmptySiphonVerdict {
        public Undecided {
            requireNonNull(reason, "reason");
        }
    }
}
