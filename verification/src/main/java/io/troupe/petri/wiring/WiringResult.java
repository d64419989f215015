package io.troupe.petri.wiring;

import java.util.List;
import java.util.Optional;

/** What a {@link WiringCheck} found out. */
public sealed interface WiringResult {
    /** The search of all markings of the whole. */
    Figures figures();

    /** The search by stubborn sets, for dead markings of the whole. */
    ReducedFigures reduced();

    /** Every two components that call each other, by themselves. */
    List<PairResult> pairs();

    /**
     * No reachable marking is dead, and from every one each component can still go on. That it does so some day, and is
     * not passed over for ever, is not said. This is known from all markings, or from those of the {@link #reduced}
     * search.
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
     * No reachable marking is dead. Whether one component can come to wait for ever while others go on is not known,
     * since the searches for that ended early.
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
     * @param stories of the dead markings, nearest first, at most 16
     * @param causes the nearest ways in which a component begins to wait for ever while others may go on; none if the
     *     search of all markings ended early
     * @param repair a synchronised stop; none if no component stops, if they already stop together, or if it would need
     *     more than 1000 combinations of states
     */
    record Deadlock(
            Figures figures,
            ReducedFigures reduced,
            List<PairResult> pairs,
            List<Story> stories,
            List<Story> causes,
            Optional<Repair> repair)
            implements WiringResult {
        public Deadlock {
            pairs = List.copyOf(pairs);
            stories = List.copyOf(stories);
            causes = List.copyOf(causes);
        }

        /** The shortest one. */
        public Story story() {
            return stories.get(0);
        }

        @Override
        public String toString() {
            return "can deadlock: " + figures + "; " + reduced + "\n" + story() + suspects(pairs)
                    + repair.map(proposal -> "\nproposal: " + proposal).orElse("");
        }
    }

    /**
     * No reachable marking is dead, but a component can come to wait for ever while others go on.
     *
     * @param stories ways to this; the nearest ones if the search of all markings is complete
     * @param repair a synchronised stop; none if no component stops, if they already stop together, or if it would need
     *     more than 1000 combinations of states
     */
    record Blocked(
            Figures figures,
            ReducedFigures reduced,
            List<PairResult> pairs,
            List<Story> stories,
            Optional<Repair> repair)
            implements WiringResult {
        public Blocked {
            pairs = List.copyOf(pairs);
            stories = List.copyOf(stories);
        }

        /** The first one. */
        public Story story() {
            return stories.get(0);
        }

        @Override
        public String toString() {
            return "a component can wait for ever: " + figures + (figures.isComplete() ? "" : "; " + reduced) + "\n"
                    + story() + suspects(pairs)
                    + repair.map(proposal -> "\nproposal: " + proposal).orElse("");
        }
    }

    /** Both searches ended early, at their limit or cancelled, and met no dead marking; there may be some beyond. */
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
