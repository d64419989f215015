package io.troupe.petri.structure;

import static java.util.Objects.requireNonNull;

import java.util.List;

/** What the siphons of a net prove about dead markings. */
public sealed interface DeadlockVerdict {
    /**
     * Proved: no reachable marking is dead. In a dead marking the unmarked places form a siphon, but no minimal siphon
     * can be emptied.
     *
     * @param proofs one for every minimal siphon
     */
    record NoDeadMarking(List<SiphonVerdict.CannotBeEmptied> proofs) implements DeadlockVerdict {
        public NoDeadMarking {
            proofs = List.copyOf(proofs);
        }

        /** Whether every minimal siphon contains an initially marked trap (Commoner's property). */
        public boolean isByTrapsAlone() {
            return proofs.stream().allMatch(SiphonVerdict.HoldsMarkedTrap.class::isInstance);
        }
    }

    /**
     * Undecided: these minimal siphons may be emptied. Even a siphon that is emptied need not lead to a dead marking;
     * only a search of the markings can decide that.
     */
    record Candidates(List<SiphonVerdict> siphons) implements DeadlockVerdict {
        public Candidates {
            siphons = List.copyOf(siphons);
        }
    }

    /** Undecided, with the reason: siphons cannot decide it for this net, or not all of them are known. */
    record Undecided(String reason) implements DeadlockVerdict {
        public Undecided {
            requireNonNull(reason, "reason");
        }
    }
}
