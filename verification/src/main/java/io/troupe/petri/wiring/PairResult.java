package io.troupe.petri.wiring;

import java.util.List;

/**
 * The result for two components while all others answer and call them at any time.
 *
 * <p>A pair that can deadlock is a suspect with a short explanation: in the whole, the other components may prevent it.
 * Pairs without a deadlock do not exclude a circle of three.
 *
 * @param one the component that was added to the wiring first
 * @param figures of the net of the two
 * @param counterexamples of its dead markings, nearest first, at most 16; if there are none, how one of the two can
 *     wait for ever although the other goes on
 */
public record PairResult(String one, String other, Figures figures, List<Counterexample> counterexamples) {
    public PairResult {
        counterexamples = List.copyOf(counterexamples);
    }

    /** Whether all markings of the pair were visited, and both components can go on from each of them. */
    public boolean isFree() {
        return counterexamples.isEmpty() && figures.isComplete();
    }

    /** The figures and the sentences of the counterexamples. */
    @Override
    public String toString() {
        var text = new StringBuilder(one + " and " + other + ": " + figures);
        counterexamples.forEach(counterexample -> text.append("\n  ").append(counterexample.sentence()));
        return text.toString();
    }
}
