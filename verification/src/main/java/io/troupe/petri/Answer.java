package io.troupe.petri;

import static java.util.Objects.requireNonNull;

/**
 * The answer to a question about everything that a net can do: yes with the reason, no with what shows it, or unknown
 * with the reason.
 *
 * {@snippet :
 * var result = DeadlockCheck.decide(net, SearchLimits.markings(1_000_000));
 * assertThat(result).isInstanceOf(Yes.class);
 * }
 *
 * <p><b>Role.</b> From {@link io.troupe.petri.deadlock.DeadlockCheck}, {@link DeadlockSearch#first} and
 * {@link FairRuns}.
 *
 * @param <T> what shows a no
 */
public sealed interface Answer<T> {
    /**
     * It is so.
     *
     * @param proof how it was proved, in words
     * @param markings how many markings were visited for the proof, or orbits of these; 0 without a search
     */
    record Yes<T>(String proof, int markings) implements Answer<T> {
        public Yes {
            requireNonNull(proof, "proof");
        }
    }

    /** It is not so, as this shows. */
    record No<T>(T counterexample) implements Answer<T> {
        public No {
            requireNonNull(counterexample, "counterexample");
        }
    }

    /**
     * Not known.
     *
     * @param end why the search ended
     * @param markings how many markings, or orbits of these, were visited; none of them shows a no
     */
    record Unknown<T>(SearchEnd end, int markings) implements Answer<T> {
        public Unknown {
            requireNonNull(end, "end");
        }
    }
}
