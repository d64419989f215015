package io.troupe.petri.wiring;

import io.troupe.petri.wiring.ProtocolEvent.Kind;
import io.troupe.petri.wiring.WiringNet.Event;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Stream;

/**
 * Calls that a component accepts in one state and answers in a later one. Which answers it owes depends on its state;
 * who waits for them is a place for each caller. If several wait for the same, any of them is answered.
 */
final class AcceptedCalls {
    /**
     * Someone whose call may be accepted.
     *
     * @param component the caller
     * @param waits whether it does nothing else meanwhile
     * @param asked the place of a call that is not accepted yet; empty for one that was accepted before
     * @param open the place of a call that is accepted
     * @param answered the places after its answer
     * @param rejected the places after its rejection
     */
    private record Caller(
            String component,
            String words,
            boolean waits,
            List<String> asked,
            String open,
            List<String> answered,
            List<String> rejected) {
        /** Where an answer goes that no caller waits for. */
        boolean isGone() {
            return asked.isEmpty();
        }
    }

    private final WiringNet net;
    private final Wiring wiring;
    private final WiringNet.Draft draft;
    private final Map<String, List<Caller>> callers = new LinkedHashMap<>(); // by component.call
    private final Set<String> gone = new HashSet<>();

    AcceptedCalls(WiringNet net) {
        this.net = net;
        wiring = net.wiring();
        draft = net.draft();
    }

    /** Adds a caller that waits for its answer; {@code words} name it. */
    void request(
            String caller,
            String words,
            String target,
            String asked,
            String open,
            String answered,
            List<String> rejected) {
        add(target, new Caller(caller, words, true, List.of(asked), open, List.of(answered), rejected));
    }

    /** Adds a caller that goes on. */
    void question(String caller, String target, String asked, String open, String answered, List<String> rejected) {
        add(
                target,
                new Caller(
                        caller, caller + ", which goes on", false, List.of(asked), open, List.of(answered), rejected));
    }

    /** The place of a call that is accepted and not answered, although its caller gave it up. */
    String gone(String caller, String target) {
        var place = caller + " has given up the answer of " + target;
        if (gone.add(place)) {
            draft.place(place, 0);
            add(
                    target,
                    new Caller(caller, caller + ", which has given up", false, List.of(), place, List.of(), List.of()));
        }
        return place;
    }

    private void add(String target, Caller caller) {
        callers.computeIfAbsent(target, key -> new ArrayList<>()).add(caller);
    }

    /** Adds the steps of all components that accept calls, after all callers were added. */
    void add() {
        for (var component : wiring.components()) {
            if (net.chosen().contains(component)) {
                wiring.protocol(component).steps().forEach(step -> step(component, step));
                failures(component);
            }
        }
    }

    private void step(String provider, Step step) {
        switch (step) {
            case Step.Accepts accepts ->
                callers(provider, accepts.call())
                        .filter(caller -> !caller.isGone())
                        .forEach(caller -> end(
                                provider,
                                step,
                                accepts.call(),
                                " of ",
                                Kind.TAKEN,
                                caller,
                                caller.asked(),
                                List.of(caller.open())));
            case Step.Answers answers -> {
                outside(provider, step, answers.call());
                callers(provider, answers.call())
                        .forEach(caller -> end(
                                provider,
                                step,
                                answers.call(),
                                " to ",
                                Kind.ANSWERED,
                                caller,
                                List.of(caller.open()),
                                caller.answered()));
            }
            case Step.Refuses refuses -> {
                outside(provider, step, refuses.call());
                callers(provider, refuses.call())
                        .forEach(caller -> end(
                                provider,
                                step,
                                refuses.call(),
                                " of ",
                                Kind.REJECTED,
                                caller,
                                List.of(caller.open()),
                                caller.rejected()));
            }
            default -> {}
        }
    }

    private Stream<Caller> callers(String provider, String call) {
        return callers.getOrDefault(provider + "." + call, List.of()).stream();
    }

    private void end(
            String provider,
            Step step,
            String call,
            String of,
            Kind kind,
            Caller caller,
            List<String> in,
            List<String> out) {
        var who = caller.waits() ? Event.of(caller.component(), provider) : Event.of(provider);
        var event = who.begins(provider, step).seen(kind, caller.component(), provider + "." + call);
        draft.step(
                net.labels().label(provider, wiring.protocol(provider), step) + of + caller.words(),
                caller.isGone() ? event.orUnseen() : event,
                joined(in, WiringNet.at(provider, step.from())),
                joined(out, WiringNet.at(provider, step.to())));
    }

    /** The end of a call from outside, which no component of the net waits for. */
    private void outside(String provider, Step step, String call) {
        if (!net.isCalled(provider, call)) {
            var label = net.labels().label(provider, wiring.protocol(provider), step);
            var verb = step instanceof Step.Answers ? "answers " : "refuses ";
            draft.step(
                    label,
                    Event.of(provider).begins(provider, step).seen(Kind.DID, provider, verb + call),
                    List.of(WiringNet.at(provider, step.from())),
                    List.of(WiringNet.at(provider, step.to())));
        }
    }

    private static List<String> joined(List<String> places, String more) {
        var joined = new ArrayList<>(places);
        joined.add(more);
        return joined;
    }

    /** The place of a component that has just failed and owes these answers: it rejects them, one by one. */
    String failed(String component, List<String> owed) {
        return owed.isEmpty() ? net.questions().failed(component) : component + " has failed, and owes " + owed;
    }

    private void failures(String component) {
        var protocol = wiring.protocol(component);
        var all = new LinkedHashSet<List<String>>();
        for (var state : protocol.states()) {
            if (protocol.failsIn(state)) {
                var owed = protocol.owed(state);
                for (var i = 0; i < owed.size(); i++) {
                    all.add(owed.subList(i, owed.size()));
                }
            }
        }
        for (var owed : all) {
            var here = failed(component, owed);
            var next = failed(component, owed.subList(1, owed.size()));
            draft.local(component, here, 0, new WiringNet.ComponentState.Other());
            if (!net.isCalled(component, owed.get(0))) {
                draft.step(here + ": from outside", component, List.of(here), List.of(next));
            }
            callers(component, owed.get(0))
                    .forEach(caller -> draft.step(
                            here + " of " + caller.words(),
                            component,
                            List.of(here, caller.open()),
                            joined(caller.rejected(), next)));
        }
    }
}
