package io.troupe.petri.wiring;

import java.util.List;

/**
 * What two components do to each other while everybody else answers and calls them at any time.
 *
 * <p>A pair that is in trouble is a suspect with a short explanation: in the whole, the others may keep it from getting
 * there. Pairs without trouble prove nothing about a circle of three.
 *
 * @param one the one that was added to the wiring first
 * @param figures of the net of the two
 * @param stories of its dead markings, nearest first, at most 16; without any of these, how one of the two can wait for
 *     ever although the other goes on
 */
public record PairResult(String one, String other, Figures figures, List<Story> stories) {
    public PairResult {
        stories = List.copyOf(stories);
    }

    /** Whether all markings of the pair were visited, and from each of them both can go on. */
    public boolean isFree() {
        return stories.isEmpty() && figures.isComplete();
    }

    /** The figures and the sentences of the stories. */
    @Override
    public String toString() {
        var text = new StringBuilder(one + " and " + other + ": " + figures);
        stories.forEach(story -> text.append("\n  ").append(story.sentence()));
        return text.toString();
    }
}
