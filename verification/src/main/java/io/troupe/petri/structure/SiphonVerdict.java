package io.troupe.petri.structure;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.ReachabilityGraph;
import java.util.OptionalDouble;

/** Whether one siphon is empty in some reachable marking, as far as it is known, with the proof. */
public sealed interface SiphonVerdict {
    PlaceSet siphon();

    /** Proved: the siphon holds a token in every reachable marking, and so does every set that contains it. */
    sealed interface CannotBeEmptied extends SiphonVerdict {}

    /**
     * The siphon contains a trap that is marked initially, and therefore always.
     *
     * @param trap the largest one in the siphon
     */
    record HoldsMarkedTrap(PlaceSet siphon, PlaceSet trap) implements CannotBeEmptied {
        public HoldsMarkedTrap {
            if (!siphon.containsAll(trap) || !Siphons.isTrap(trap)) {
                throw new IllegalArgumentException(trap + " is not a trap in " + siphon);
            }
            if (!trap.isMarked(trap.net().initialMarking())) {
                throw new IllegalArgumentException("trap " + trap + " is not marked initially");
            }
        }
    }

    /** By the state equation the siphon always holds at least one token. */
    record HoldsTokens(TokenBound bound) implements CannotBeEmptied {
        public HoldsTokens {
            if (bound.tokens() < 1) {
                throw new IllegalArgumentException(bound + ", expected 1 or more");
            }
        }

        @Override
        public PlaceSet siphon() {
            return bound.set();
        }
    }

    /** All reachable markings were visited, and the siphon is empty in none of them. */
    record NeverEmpty(PlaceSet siphon) implements CannotBeEmptied {
        public NeverEmpty {
            requireNonNull(siphon, "siphon");
        }
    }

    /** Proved: the siphon is empty in this marking, whose trace shows how it was emptied. */
    record Emptied(PlaceSet siphon, ReachabilityGraph.State state) implements SiphonVerdict {
        public Emptied {
            if (siphon.isMarked(state.marking())) {
                throw new IllegalArgumentException(siphon + " is not empty in " + state);
            }
        }
    }

    /**
     * A candidate: neither proved nor refuted. Confirm it by {@link SiphonAnalysis#confirm}.
     *
     * @param leastTokens the fewest tokens by the state equation; empty if the solver failed
     */
    record MayBeEmptied(PlaceSet siphon, OptionalDouble leastTokens) implements SiphonVerdict {
        public MayBeEmptied {
            requireNonNull(siphon, "siphon");
            requireNonNull(leastTokens, "leastTokens");
        }
    }
}
