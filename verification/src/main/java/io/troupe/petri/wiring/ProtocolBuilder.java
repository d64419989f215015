package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.common.text.Suggestions;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.function.BiConsumer;
import java.util.regex.Pattern;
import java.util.stream.Stream;

/**
 * Collects the states of a {@link Protocol}.
 *
 * <p><b>Role.</b> From {@link Protocol#of}; continue with {@link #state}.
 *
 * <p><b>Threads.</b> Not thread-safe.
 *
 * <p><b>Errors.</b> An illegal name throws {@link IllegalArgumentException} at once; {@link #build} throws it for
 * errors that need the whole declaration.
 */
public final class ProtocolBuilder {
    private static final Pattern NAME = Pattern.compile("[\\p{L}\\p{N}_-]+");

    private final String name;
    private final Optional<ActorWords> actor;
    private final List<String> states = new ArrayList<>();
    private final List<Step> steps = new ArrayList<>();
    private Optional<String> failure = Optional.empty();

    ProtocolBuilder(String name, Optional<ActorWords> actor) {
        requireName("the name of a protocol", requireNonNull(name, "name"));
        this.name = name;
        this.actor = actor;
    }

    /**
     * Declares a state and the ways out of it: one way is the next step, several are a choice.
     *
     * <p>For example {@code state("ready", provides("setValues").then("loaded"), stops())}.
     */
    public ProtocolBuilder state(String state, Branch... branches) {
        requireReadable("state", state);
        require(!states.contains(state), "state " + state + " is declared twice");
        require(branches.length > 0, "nothing leads out of state " + state + "; expected a step, a stop or ends()");
        require(
                branches.length == 1 || Stream.of(branches).noneMatch(branch -> branch.kind() == Branch.Kind.ENDS),
                "state " + state + " ends and has other ways out; expected ends() alone");
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
            case ENDS -> {} // see state
            case STOPS ->
                require(
                        !state.equals(states.get(0)),
                        "state " + state + " is the first one and stops; expected a stop in a later state");
            default -> {
                if (branch.kind().hasTarget()) {
                    requireTarget(state, branch);
                } else {
                    requireWord(wordOf(branch.kind()), branch.what());
                    actor.ifPresent(words -> words.require(state, branch));
                }
            }
        }
    }

    private static String wordOf(Branch.Kind kind) {
        return switch (kind) {
            case RECEIVES -> "received message";
            case ACQUIRES, RELEASES -> "resource";
            default -> "offered call";
        };
    }

    private void requireTarget(String state, Branch branch) {
        var isMessage = branch.kind() == Branch.Kind.SENDS;
        var word = isMessage ? "message" : "call";
        var dot = branch.what().indexOf('.');
        require(dot > 0, "state " + state + " " + branch + ", expected component." + word);
        var owner = (isMessage ? "message " : "request ") + branch.what();
        requireWord("component of " + owner, branch.what().substring(0, dot));
        requireWord(word + " of " + owner, branch.what().substring(dot + 1));
    }

    /**
     * Lets the component fail at any moment in every other state, also while it waits for an answer or serves a call;
     * it then is in {@code state}. A call that it serves is rejected, a stream that it has open is rejected, its own
     * questions are cancelled, and what it holds is released. The mailbox keeps its messages.
     *
     * <p>The way from {@code state} back to another one is the restart. Calls that it rejects until then are declared
     * there by {@link Protocol#rejects}.
     */
    public ProtocolBuilder failsTo(String state) {
        require(failure.isEmpty(), "failsTo is declared twice, expected one state");
        failure = Optional.of(requireNonNull(state, "state"));
        return this;
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
            step.targets().forEach(to -> requireDeclared("a step of state " + step.from() + " leads", to));
        }
        failure.ifPresent(state -> requireDeclared("a failure leads", state));
        var held = along("holding", this::held);
        var owed = along("owing the answers of", this::owed);
        for (var state : states) {
            require(
                    held.containsKey(state),
                    "state " + state + " cannot be reached from the first state " + states.get(0)
                            + "; expected a step that leads to it");
        }
        requireTakenOnlyIfAsked();
        var protocol = new Protocol(name, states, steps, failure, held, owed);
        for (var offer : protocol.steps(Step.Incoming.class).toList()) {
            require(
                    !(offer instanceof Step.Accepts)
                            || steps.stream()
                                    .anyMatch(step -> step instanceof Step.Answers answers
                                                    && answers.call().equals(offer.call())
                                            || step instanceof Step.Refuses refuses
                                                    && refuses.call().equals(offer.call())),
                    "state " + offer.from() + " accepts " + offer.call()
                            + ", which no state answers or refuses; expected" + " answers(\"" + offer.call()
                            + "\") in a later state");
            if (!(offer instanceof Step.Provides || offer instanceof Step.Accepts)) {
                continue;
            }
            require(
                    !protocol.isStream(offer.call()),
                    "call " + offer.call() + " is answered once in state " + offer.from()
                            + " and is a stream elsewhere; expected one of the two");
        }
        protocol.steps()
                .forEach(step -> requireStream(
                        protocol,
                        step instanceof Step.Emits emits
                                ? emits.call()
                                : step instanceof Step.Finishes finishes ? finishes.call() : "",
                        step.from()));
        return protocol;
    }

    private void requireStream(Protocol protocol, String call, String state) {
        require(
                call.isEmpty() || protocol.isStream(call),
                "state " + state + " emits or finishes " + call + ", which is no stream; expected streams(\"" + call
                        + "\") in a state");
    }

    private void requireDeclared(String what, String state) {
        require(
                states.contains(state),
                what + " to state " + state + ", which is not declared; " + Suggestions.hintWithAll(state, states));
    }

    private void requireTakenOnlyIfAsked() {
        var asked = steps.stream()
                .filter(Step.Asks.class::isInstance)
                .map(step -> ((Step.Asks) step).target())
                .distinct()
                .toList();
        for (var step : steps) {
            if (step instanceof Step.Takes || step instanceof Step.Cancels) {
                var target = ((Step.Outgoing) step).target();
                require(
                        asked.contains(target),
                        "state " + step.from() + " takes or cancels an answer of " + target + ", which is never asked; "
                                + Suggestions.hintWithAll(target, asked));
            }
        }
    }

    /** By state that can be reached: what a component has to give back in it, which each step adds to or takes from. */
    private Map<String, List<String>> along(String having, BiConsumer<Step, List<String>> change) {
        var all = new LinkedHashMap<String, List<String>>();
        all.put(states.get(0), List.of());
        failure.ifPresent(state -> all.put(state, List.of()));
        var ahead = new ArrayDeque<>(all.keySet());
        while (!ahead.isEmpty()) {
            var state = ahead.remove();
            for (var step : steps) {
                if (!step.from().equals(state)) {
                    continue;
                }
                var changed = new ArrayList<>(requireNonNull(all.get(state)));
                change.accept(step, changed);
                var after = changed.stream().sorted().toList();
                step.targets().forEach(to -> {
                    var other = all.putIfAbsent(to, after);
                    require(
                            other == null || other.equals(after),
                            "state " + to + " is reached " + having + " " + after + " and " + having + " " + other
                                    + "; expected the same on every way there");
                    if (other == null) {
                        ahead.add(to);
                    }
                });
            }
        }
        return all;
    }

    private void held(Step step, List<String> held) {
        switch (step) {
            case Step.Acquires acquires -> held.add(acquires.resource());
            case Step.Releases releases ->
                require(
                        held.remove(releases.resource()),
                        "state " + step.from() + " releases " + releases.resource() + ", but it holds " + held
                                + " there; expected a resource that it acquired before");
            case Step.Stops stops ->
                require(
                        held.isEmpty(),
                        "state " + step.from() + " stops holding " + held + "; expected releases before the stop");
            case Step.Ends ends ->
                require(
                        held.isEmpty(),
                        "state " + step.from() + " ends holding " + held + "; expected releases before the end");
            default -> {}
        }
    }

    private void owed(Step step, List<String> owed) {
        switch (step) {
            case Step.Accepts accepts -> owed.add(accepts.call());
            case Step.Answers answers -> requireAccepted(step, "answers ", answers.call(), owed);
            case Step.Refuses refuses -> requireAccepted(step, "refuses ", refuses.call(), owed);
            case Step.Stops stops ->
                require(
                        owed.isEmpty(),
                        "state " + step.from() + " stops owing the answers of " + owed
                                + "; expected answers before the stop");
            case Step.Ends ends ->
                require(
                        owed.isEmpty(),
                        "state " + step.from() + " ends owing the answers of " + owed
                                + "; expected answers before the end");
            default -> {}
        }
    }

    private void requireAccepted(Step step, String verb, String call, List<String> owed) {
        require(
                owed.remove(call),
                "state " + step.from() + " " + verb + call + ", but it owes the answers of " + owed
                        + " there; expected accepts(\"" + call + "\") before");
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
