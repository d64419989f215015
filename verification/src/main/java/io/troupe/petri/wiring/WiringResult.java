package io.troupe.petri.wiring;

import java.util.List;
import java.util.Optional;

/** The result of a {@link WiringCheck}. */
public sealed interface WiringResult {
    /** The figures of the search of all markings of the whole. */
    Figures figures();

    /** The figures of the search by stubborn sets for dead markings of the whole. */
    ReducedFigures reduced();

    /** The results for every two components that call each other. */
    List<PairResult> pairs();

    /**
     * No reachable marking is dead, and from each of them every component can still go on, or has ended. Fairness is
     * not proved: a component that can always go on may still be passed over for ever. The proof is from all markings,
     * or from those of the {@link #reduced} search.
     */
    record Proved(Figures figures, ReducedFigures reduced, List<PairResult> pairs) implements WiringResult {
        public Proved {
            pairs = List.copyOf(pairs);
        }

        @Override
        public String toString() {
            return "proved free of deadlock: " + figures + (figures.isComplete() ? "" : "; " + reduced);
        }
    }

    /**
     * No reachable marking is dead. Whether a component can come to wait for ever while others go on is unknown,
     * because the searches for that ended early.
     */
    record DeadlockFree(Figures figures, ReducedFigures reduced, List<PairResult> pairs) implements WiringResult {
        public DeadlockFree {
            pairs = List.copyOf(pairs);
        }

        @Override
        public String toString() {
            return "proved that never all wait for ever: " + reduced
                    + "; not known whether one can while others go on: " + figures + suspects(pairs);
        }
    }

    /**
     * All components can come to wait for ever.
     *
     * @param counterexamples of the dead markings, nearest first, at most 16
     * @param causes the nearest ways in which a component begins to wait for ever while others may go on; empty if the
     *     search of all markings ended early
     * @param repair a synchronised stop; empty if no component stops, if they already stop together, or if it would
     *     need more than 1000 combinations of states
     */
    record Deadlock(
            Figures figures,
            ReducedFigures reduced,
            List<PairResult> pairs,
            List<Counterexample> counterexamples,
            List<Counterexample> causes,
            Optional<Repair> repair)
            implements WiringResult {
        public Deadlock {
            pairs = List.copyOf(pairs);
            counterexamples = List.copyOf(counterexamples);
            causes = List.copyOf(causes);
        }

        /** The shortest counterexample. */
        public Counterexample counterexample() {
            return counterexamples.get(0);
        }

        @Override
        public String toString() {
            return "can deadlock: " + figures + "; " + reduced + "\n" + counterexample() + suspects(pairs)
                    + repair.map(proposal -> "\nproposal: " + proposal).orElse("");
        }
    }

    /**
     * No reachable marking is dead, but a component can come to wait for ever while others go on.
     *
     * @param counterexamples ways to this; the nearest ones if the search of all markings is complete
     * @param repair a synchronised stop; empty if no component stops, if they already stop together, or if it would
     *     need more than 1000 combinations of states
     */
    record Blocked(
            Figures figures,
            ReducedFigures reduced,
            List<PairResult> pairs,
            List<Counterexample> counterexamples,
            Optional<Repair> repair)
            implements WiringResult {
        public Blocked {
            pairs = List.copyOf(pairs);
            counterexamples = List.copyOf(counterexamples);
        }

        /** The first counterexample. */
        public Counterexample counterexample() {
            return counterexamples.get(0);
        }

        @Override
        public String toString() {
            return "a component can wait for ever: " + figures + (figures.isComplete() ? "" : "; " + reduced) + "\n"
                    + counterexample() + suspects(pairs)
                    + repair.map(proposal -> "\nproposal: " + proposal).orElse("");
        }
    }

    /** Both searches ended early, at their limit or cancelled, and found no dead marking; there may be some beyond. */
    record Unknown(Figures figures, ReducedFigures reduced, List<PairResult> pairs) implements WiringResult {
        public Unknown {
            pairs = List.copyOf(pairs);
        }

        @Override
        public String toString() {
            return "not known: no dead marking so far, " + figures + "; " + reduced + suspects(pairs);
        }
    }

    private static String suspects(List<PairResult> pairs) {
        var text = new StringBuilder();
        pairs.stream()
                .filter(pair -> !pair.isFree())
                .forEach(pair -> text.append("\npair ").append(pair));
        return text.toString();
    }
}
