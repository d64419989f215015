package io.troupe.petri.wiring;

import java.util.List;

/**
 * How components come to wait for each other for ever.
 *
 * @param sentence what is wrong at the end, for example "player stops; robot waits for player.setValues, which nobody
 *     will answer"
 * @param firings a way from the start to there, in the words of the declaration
 * @param isShortest whether no way to this marking, or to this kind of block, is shorter
 * @param waits what each component that cannot go on waits for; in a dead marking these are all of them
 * @param circle those of {@code waits} in which each waits for the next one and the last for the first; empty if those
 *     that wait depend on a component that goes on, but never does what they wait for
 */
public record Story(String sentence, List<String> firings, boolean isShortest, List<Wait> waits, List<Wait> circle) {
    public Story {
        firings = List.copyOf(firings);
        waits = List.copyOf(waits);
        circle = List.copyOf(circle);
    }

    /** The sentence, the steps one per line, and the waits; a {@code *} marks those in the circle. */
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
