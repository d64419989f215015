package io.troupe.petri.structure;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.Transition;
import java.util.Map;

/** What {@link EmptySiphonProgram} found out about all siphons of a net at once. */
public sealed interface EmptySiphonVerdict {
    /**
     * No siphon can be emptied, by the state equation: the program has no solution.
     *
     * <p>The solver computes in floating point and leaves nothing behind that could be checked; for an exact proof see
     * {@link SiphonVerdict.HoldsMarkedTrap} and {@link SiphonVerdict.HoldsTokens}.
     *
     * @param excludesDeadMarkings whether it follows that no reachable marking is dead; so it does if the net has
     * transitions, and all their input arcs have weight 1
     */
    record NoneCanBeEmptied(boolean excludesDeadMarkings) implements EmptySiphonVerdict {}

    /**
     * A candidate only, to be confirmed by reachability: firing counts after which, by the state equation, the siphon
     * is empty. That it is a siphon, and that the counts empty it and leave no place below 0, was checked in integers;
     * that they can be put into an order in which all may fire was not.
     *
     * @param counts how often transitions fire; the others do not
     */
    record MayBeEmptied(PlaceSet siphon, Map<Transition, Long> counts) implements EmptySiphonVerdict {
        public MayBeEmptied {
            requireNonNull(siphon, "siphon");
            counts = Map.copyOf(counts);
        }
    }

    /** Nothing is known, and why. */
    record Undecided(String reason) implements EmptySiphonVerdict {
        public Undecided {
            requireNonNull(reason, "reason");
        }
    }
}
