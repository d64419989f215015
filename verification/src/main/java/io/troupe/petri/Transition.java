package io.troupe.petri;

import static java.util.Objects.requireNonNull;

import java.util.List;

/**
 * A transition of one net.
 *
 * @param index its position in {@link PetriNet#transitions()}
 * @param name unique among the places and transitions of the net
 * @param priority usually 0; a transition may not fire while one of higher priority has its tokens
 * @param inputs the tokens that one firing takes, each place once
 * @param outputs the tokens that one firing puts, each place once
 * @param inhibitors the places that must hold fewer tokens than the weight of the arc, each place once; a firing takes
 *     nothing from them
 */
public record Transition(
        int index, String name, int priority, List<Arc> inputs, List<Arc> outputs, List<Arc> inhibitors) {
    public Transition {
        requireNonNull(name, "name");
        inputs = List.copyOf(inputs);
        outputs = List.copyOf(outputs);
        inhibitors = List.copyOf(inhibitors);
    }

    /** The name. */
    @Override
    public String toString() {
        return name;
    }
}
