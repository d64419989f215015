package io.troupe.petri.wiring;

import java.util.List;

/**
 * How components come to wait for each other for ever.
 *
 * @param sentence the final state, for example {@code player stops; robot waits for player.setValues, which no
 *     component will answer}
 * @param firings a firing sequence from the start to that state, in the words of the declaration
 * @param isShortest whether no other sequence to this marking, or to this kind of block, is shorter
 * @param waits by component that cannot go on: what it waits for; in a dead marking these are all components
 * @param circle those of {@code waits} in which each waits for the next one and the last for the first; empty if the
 *     waiting components depend on one that goes on, but never does what they wait for
 */
public record Counterexample(
        String sentence, List<String> firings, boolean isShortest, List<Wait> waits, List<Wait> circle) {
    public Counterexample {
        firings = List.copyOf(firings);
        waits = List.copyOf(waits);
        circle = List.copyOf(circle);
    }

    /** The sentence, the steps one per line, and the waits; {@code *} marks those in the circle. */
    @Override
    public String toString() {
        var text = new StringBuilder(sentence);
        text.append("\n  after ")
                .append(firings.size())
                .append(isShortest ? " steps:" : " steps, perhaps not the fewest:");
        for (var i = 0; i < firings.size(); i++) {
            text.append("\n    ").append(i + 1).append(". ").append(firings.get(i));
        }
        text.append("\n  then:");
        waits.forEach(wait -> text.append("\n    ")
                .append(circle.contains(wait) ? "* " : "  ")
                .append(wait));
        return text.toString();
    }
}
