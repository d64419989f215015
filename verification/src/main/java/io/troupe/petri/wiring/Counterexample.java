package io.troupe.petri.wiring;

import java.util.List;
import java.util.Set;

/**
 * How components come to wait for each other for ever.
 *
 * @param sentence the final state, for example {@code player stops; robot waits for player.setValues, which no
 *     component will answer}
 * @param firings a firing sequence from the start to that state, in the words of the declaration
 * @param steps the same for a reader: a call that nothing disturbs is one step, and so is what a component has decided
 *     and does next
 * @param isShortest whether no other sequence to this marking, or to this kind of block, is shorter
 * @param waits by component that cannot go on: what it waits for; in a dead marking these are all components
 * @param circle those of {@code waits} in which each waits for the next one and the last for the first; empty if the
 *     waiting components depend on one that goes on, but never does what they wait for
 * @param ended the components that have ended
 */
public record Counterexample(
        String sentence,
        List<String> firings,
        List<String> steps,
        boolean isShortest,
        List<Wait> waits,
        List<Wait> circle,
        Set<String> ended) {
    public Counterexample {
        firings = List.copyOf(firings);
        steps = List.copyOf(steps);
        ended = Set.copyOf(ended);
        waits = List.copyOf(waits);
        circle = List.copyOf(circle);
    }

    /**
     * The sentence, the steps one per line, and the waits, each with the reason why it lasts; {@code *} marks those in
     * the circle.
     */
    @Override
    public String toString() {
        var text = new StringBuilder(sentence);
        text.append(ToldSteps.lines(steps, isShortest ? "" : ", perhaps not the fewest"));
        text.append("\n  then:");
        waits.forEach(wait -> text.append("\n    ")
                .append(circle.contains(wait) ? "* " : "  ")
                .append(wait)
                .append(why(wait)));
        return text.toString();
    }

    /** Why a component that waits for others which do not wait themselves waits for ever. */
    private String why(Wait wait) {
        var waiting = waits.stream().map(Wait::component).toList();
        var others = wait.on().stream().filter(each -> !waiting.contains(each)).toList();
        if (others.isEmpty()) {
            return "";
        }
        var gone = others.stream().filter(ended::contains).toList();
        var busy = others.stream().filter(each -> !ended.contains(each)).toList();
        return (gone.isEmpty()
                        ? ""
                        : "; " + String.join(" and ", gone) + (gone.size() == 1 ? " has" : " have") + " ended")
                + (busy.isEmpty()
                        ? ""
                        : ", whatever " + String.join(" and ", busy) + (busy.size() == 1 ? " does" : " do"));
    }
}
