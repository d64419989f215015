package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.common.text.Suggestions;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.regex.Pattern;

/**
 * Collects the states of a {@link Protocol}.
 *
 * <p><b>Role.</b> From {@link Protocol#of}; continue with {@link #in}.
 *
 * <p><b>Threads.</b> Not thread-safe.
 *
 * <p><b>Errors.</b> An illegal name throws {@link IllegalArgumentException} at once; {@link #build} throws it for
 * errors that need the whole declaration.
 */
public final class ProtocolBuilder {
    private static final Pattern NAME = Pattern.compile("[\\p{L}\\p{N}_-]+");

    private final String name;
    private final List<String> states = new ArrayList<>();
    private final List<Step> steps = new ArrayList<>();

    ProtocolBuilder(String name) {
        requireName("the name of a protocol", requireNonNull(name, "name"));
        this.name = name;
    }

    /**
     * Declares a state and the ways out of it: one way is the next step, several are a choice.
     *
     * <p>For example {@code in("ready", provides("setValues").then("loaded"), stops())}.
     */
    public ProtocolBuilder in(String state, Branch... branches) {
        requireReadable("state", state);
        require(!states.contains(state), "state " + state + " is declared twice");
        require(branches.length > 0, "nothing leads out of state " + state + "; expected a step or a stop");
        states.add(state);
        var names = new HashSet<String>();
        for (var branch : branches) {
            require(
                    names.add(branch.toString()),
                    "state " + state + " " + branch + " twice; expected different names for a choice");
            requireGood(state, branch);
            steps.add(branch.from(state, states.get(0)));
        }
        return this;
    }

    private void requireGood(String state, Branch branch) {
        switch (branch.kind()) {
            case DOES -> requireReadable("step", branch.what());
            case REQUESTS -> {
                var dot = branch.what().indexOf('.');
                require(dot > 0, "state " + state + " " + branch + ", expected component.call");
                requireWord(
                        "component of request " + branch.what(), branch.what().substring(0, dot));
                requireWord("call of request " + branch.what(), branch.what().substring(dot + 1));
            }
            case PROVIDES -> {
                requireWord("offered call", branch.what());
                for (var step : steps) {
                    require(
                            !(step instanceof Step.Provides offer
                                    && offer.call().equals(branch.what())),
                            "call " + branch.what() + " is offered twice, in state " + step.from() + " and in state "
                                    + state + "; expected one state that offers it");
                }
            }
            case STOPS ->
                require(
                        !state.equals(states.get(0)),
                        "state " + state + " is the first one and stops; expected a stop in a later state");
        }
    }

    private void requireWord(String what, String word) {
        requireName("protocol " + name + ": the " + what, word);
    }

    /** Rejects a name that cannot be part of {@code component.call} and of a sentence. */
    static void requireName(String what, String name) {
        if (!NAME.matcher(name).matches()) {
            throw new IllegalArgumentException(
                    what + " is \"" + name + "\", expected letters, digits, - and _ without spaces or dots");
        }
    }

    /** Checks the declaration and builds the protocol. */
    public Protocol build() {
        require(!states.isEmpty(), "there are no states; expected 1 or more");
        for (var step : steps) {
            require(
                    states.contains(step.to()),
                    "a step of state " + step.from() + " leads to state " + step.to() + ", which is not declared; "
                            + Suggestions.hintWithAll(step.to(), states));
        }
        var protocol = new Protocol(name, states, steps);
        var ahead = new ArrayDeque<>(List.of(states.get(0)));
        var reached = new HashSet<>(ahead);
        while (!ahead.isEmpty()) {
            protocol.out(ahead.remove()).stream()
                    .map(Step::to)
                    .filter(reached::add)
                    .forEach(ahead::add);
        }
        for (var state : states) {
            require(
                    reached.contains(state),
                    "state " + state + " cannot be reached from the first state " + states.get(0)
                            + "; expected a step that leads to it");
        }
        return protocol;
    }

    private void requireReadable(String what, String text) {
        requireNonNull(text, what);
        require(
                !text.isBlank()
                        && text.equals(text.strip())
                        && text.codePoints().noneMatch(Character::isISOControl),
                "a " + what + " is called \"" + text + "\", expected text without control characters or space around"
                        + " it");
    }

    private void require(boolean condition, String message) {
        if (!condition) {
            throw new IllegalArgumentException("protocol " + name + ": " + message);
        }
    }
}
