package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.wiring.ProtocolEvent.Kind;
import io.troupe.petri.wiring.Step.Takes.Outcome;
import io.troupe.petri.wiring.WiringNet.Event;
import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;

/**
 * Calls whose caller goes on: a few places for each question that a component may have open, with one token that marks
 * how far it is, and for a stream places for its items and the room that is left.
 */
final class Questions {
    private final WiringNet net;
    private final Wiring wiring;
    private final WiringNet.Draft draft;
    private final Map<String, Question> questions = new LinkedHashMap<>();

    Questions(WiringNet net) {
        this.net = net;
        wiring = net.wiring();
        draft = net.draft();
        for (var component : wiring.components()) {
            if (net.chosen().contains(component)) {
                wiring.protocol(component).steps(Step.Asks.class).forEach(step -> {
                    var question = Question.of(wiring, component, step);
                    questions.putIfAbsent(question.name(), question);
                });
            }
        }
    }

    private record Question(
            String caller,
            String provider,
            String call,
            boolean isStream,
            boolean isAccepted,
            boolean mayBeRejected,
            int window) {
        static Question of(Wiring wiring, String caller, Step.Outgoing step) {
            var provider = wiring.provider(caller, step);
            var protocol = wiring.protocol(provider);
            return new Question(
                    caller,
                    provider,
                    step.call(),
                    protocol.isStream(step.call()),
                    protocol.answersLater(step.call()),
                    protocol.mayReject(step.call()),
                    wiring.window(provider, step.call()));
        }

        static String name(String caller, String target) {
            return caller + "'s question " + target;
        }

        String name() {
            return name(caller, target());
        }

        String target() {
            return provider + "." + call;
        }

        String none() {
            return name() + " is not open";
        }

        String asked() {
            return name() + " is not taken";
        }

        /** Being served, or an open stream. */
        String open() {
            return name() + (isStream ? " is a stream" : " is served");
        }

        /** Accepted, to be answered in another state of the provider. */
        String accepted() {
            return name() + " is accepted";
        }

        /** Answered, or the end of a stream. */
        String settled() {
            return name() + (isStream ? " is finished" : " is answered");
        }

        String rejected() {
            return name() + " is rejected";
        }

        String item() {
            return name() + " has an item";
        }

        String room() {
            return name() + " has room";
        }

        /** The room of a window that holds {@code items}, and these. */
        List<String> holding(int items, String... more) {
            var all = new ArrayList<>(List.of(more));
            if (isStream) {
                all.addAll(Collections.nCopies(items, item()));
                all.addAll(Collections.nCopies(window - items, room()));
            }
            return all;
        }
    }

    /** The place that is marked while this question is not open. */
    String notOpen(String caller, String target) {
        return requireNonNull(questions.get(Question.name(caller, target))).none();
    }

    /** The place of a component that has just failed: there it closes its questions and streams, one by one. */
    String failed(String component) {
        return closing(component).isEmpty()
                ? WiringNet.at(component, wiring.protocol(component).failure().orElseThrow())
                : closing(component, 0);
    }

    private String closing(String component, int number) {
        return number < closing(component).size()
                ? component + " has failed, and closes " + closing(component).get(number)
                : WiringNet.at(component, wiring.protocol(component).failure().orElseThrow());
    }

    /** What a component closes when it fails: the names of its questions and of its streams. */
    private List<String> closing(String component) {
        var names = new ArrayList<String>();
        questions.values().stream()
                .filter(question -> question.caller().equals(component))
                .forEach(question -> names.add(question.name()));
        streams(component).forEach(call -> names.add(component + "." + call));
        return names;
    }

    /** The streams of a provider that components of the net ask for. */
    private List<String> streams(String provider) {
        return questions.values().stream()
                .filter(question -> question.isStream() && question.provider().equals(provider))
                .map(Question::call)
                .distinct()
                .toList();
    }

    private List<Question> asking(String provider, String call) {
        return questions.values().stream()
                .filter(question ->
                        question.provider().equals(provider) && question.call().equals(call))
                .toList();
    }

    /** Whether its provider, while it has the question, is on a place of this call; else it only accepts it. */
    private boolean isServed(Question question) {
        return question.isStream()
                || !net.chosen().contains(question.provider())
                || wiring.protocol(question.provider()).answersAtOnce(question.call());
    }

    /** Adds all questions, and the steps of the components that have to do with them. */
    void add() {
        for (var component : wiring.components()) {
            if (net.chosen().contains(component)) {
                streams(component).forEach(call -> draft.place(idle(component, call), 1));
                failures(component);
            }
        }
        for (var question : questions.values()) {
            draft.place(question.none(), 1);
            var unanswered = new WiringNet.ComponentState.Unanswered(question.caller(), question.target());
            draft.place(question.asked(), 0, unanswered);
            if (isServed(question)) {
                draft.place(
                        question.open(), 0, question.isStream() ? new WiringNet.ComponentState.Other() : unanswered);
            }
            draft.place(question.settled(), 0);
            if (question.mayBeRejected()) {
                draft.place(question.rejected(), 0);
            }
            if (question.isStream()) {
                draft.place(question.item(), 0);
                draft.place(question.room(), question.window());
            }
            if (net.chosen().contains(question.provider())) {
                if (question.isAccepted()) {
                    draft.place(question.accepted(), 0, unanswered);
                    net.accepted()
                            .question(
                                    question.caller(),
                                    question.target(),
                                    question.asked(),
                                    question.accepted(),
                                    question.settled(),
                                    question.mayBeRejected() ? List.of(question.rejected()) : List.of());
                }
                served(question);
            } else {
                servedOutside(question);
            }
        }
        for (var component : wiring.components()) {
            if (net.chosen().contains(component)) {
                wiring.protocol(component).outgoing().forEach(step -> callerStep(component, step));
                wiring.protocol(component).steps().forEach(step -> providerStep(component, step));
            }
        }
    }

    private static String idle(String provider, String call) {
        return provider + "." + call + " has no stream";
    }

    private void failures(String component) {
        var closing = closing(component);
        if (wiring.protocol(component).failure().isEmpty()) {
            return;
        }
        for (var i = 0; i < closing.size(); i++) {
            var here = closing(component, i);
            var next = closing(component, i + 1);
            draft.local(component, here, 0, new WiringNet.ComponentState.Other());
            var question = questions.get(closing.get(i));
            if (question != null) {
                cancel(question, here, Event.of(component), List.of(here), List.of(next));
                continue;
            }
            var call = closing.get(i).substring(component.length() + 1);
            draft.step(
                    here + ": none",
                    component,
                    List.of(here, idle(component, call)),
                    List.of(next, idle(component, call)));
            for (var asking : asking(component, call)) {
                draft.step(
                        here + " of " + asking.caller(),
                        component,
                        List.of(here, asking.open()),
                        List.of(next, asking.rejected(), idle(component, call)));
            }
        }
    }

    /** The steps of the provider that take a question and answer it. */
    private void served(Question question) {
        var provider = question.provider();
        var target = question.target();
        var from = ", asked by " + question.caller();
        var protocol = wiring.protocol(provider);
        for (var service : net.services(provider, question.call())) {
            var call = question.call() + service.where();
            draft.step(
                    provider + " takes " + call + from,
                    Event.of(provider).begins(provider, service.offer()).seen(Kind.TAKEN, question.caller(), target),
                    List.of(
                            question.asked(),
                            WiringNet.at(provider, service.offer().from())),
                    List.of(question.open(), service.before()));
            draft.step(
                    provider + " answers " + call + from,
                    Event.of(provider).seen(Kind.ANSWERED, question.caller(), target),
                    List.of(question.open(), service.after()),
                    List.of(
                            question.settled(),
                            WiringNet.at(provider, service.offer().to())));
            net.failsServing(
                    provider,
                    service,
                    question.caller() + ", which goes on",
                    question.open(),
                    List.of(question.rejected()));
        }
        protocol.steps(Step.Streams.class)
                .filter(step -> step.call().equals(question.call()))
                .forEach(step -> draft.step(
                        net.labels().label(provider, protocol, step) + " to " + question.caller(),
                        Event.of(provider).begins(provider, step).seen(Kind.TAKEN, question.caller(), target),
                        List.of(question.asked(), idle(provider, question.call()), WiringNet.at(provider, step.from())),
                        List.of(question.open(), WiringNet.at(provider, step.to()))));
        protocol.steps(Step.Rejects.class)
                .filter(step -> step.call().equals(question.call()))
                .forEach(step -> draft.step(
                        provider + " rejects " + question.call() + from + ", in " + step.from(),
                        Event.of(provider).begins(provider, step).seen(Kind.REJECTED, question.caller(), target),
                        List.of(question.asked(), WiringNet.at(provider, step.from())),
                        List.of(question.rejected(), WiringNet.at(provider, step.to()))));
    }

    /** A provider outside of the net answers, emits, finishes and rejects at any time. */
    private void servedOutside(Question question) {
        outside(question, " takes ", List.of(question.asked()), List.of(question.open()));
        if (question.isStream()) {
            outside(
                    question,
                    " emits ",
                    List.of(question.open(), question.room()),
                    List.of(question.open(), question.item()));
        }
        outside(
                question,
                question.isStream() ? " finishes " : " answers ",
                List.of(question.open()),
                List.of(question.settled()));
        if (question.mayBeRejected()) {
            outside(question, " rejects ", List.of(question.open()), List.of(question.rejected()));
        }
    }

    private void outside(Question question, String verb, List<String> in, List<String> out) {
        draft.step(
                question.provider() + verb + question.call() + ", asked by " + question.caller(),
                new Event(Set.of(), Set.of()),
                in,
                out);
    }

    private void callerStep(String component, Step.Outgoing step) {
        if (!(step instanceof Step.Asks || step instanceof Step.Takes || step instanceof Step.Cancels)) {
            return;
        }
        var question = questions.get(Question.of(wiring, component, step).name());
        if (question == null) {
            throw new IllegalStateException(component + " never asks " + step.target());
        }
        var begins = Event.of(component).begins(component, step);
        var label = net.labels().label(component, wiring.protocol(component), step);
        var from = WiringNet.at(component, step.from());
        var to = WiringNet.at(component, step.to());
        switch (step) {
            case Step.Asks asks -> {
                var begun = net.begun(component, asks);
                draft.step(
                        label,
                        begun.event().seen(Kind.ASKED, component, question.target()),
                        List.of(begun.place(), question.none()),
                        List.of(to, question.asked()));
            }
            case Step.Cancels cancels -> {
                var event = begins.seen(Kind.GAVE_UP, component, question.target());
                cancel(question, label, event, List.of(from), List.of(to));
            }
            case Step.Takes takes
            when takes.outcome() == Outcome.ANSWER ->
                draft.step(
                        label,
                        begins.seen(Kind.GOT_ANSWER, component, question.target()),
                        List.of(from, question.isStream() ? question.item() : question.settled()),
                        List.of(to, question.isStream() ? question.room() : question.none()));
            case Step.Takes takes -> {
                var isEnd = takes.outcome() == Outcome.END;
                draft.step(
                        label,
                        begins.seen(isEnd ? Kind.GOT_END : Kind.GOT_REJECTION, component, question.target()),
                        question.holding(0, from, isEnd ? question.settled() : question.rejected()),
                        question.holding(0, to, question.none()));
            }
            default -> {}
        }
    }

    /** The transitions that close a question, one for each way in which it may be open. */
    private void cancel(Question question, String label, Event event, List<String> in, List<String> out) {
        cancel(question, label + ": not open", event, in, question.none(), out, List.of());
        cancel(question, label + ": not taken", event, in, question.asked(), out, List.of());
        if (!question.isStream()) {
            var given = net.chosen().contains(question.provider())
                    ? List.of(net.abandoned(question.caller(), question.provider(), question.call()))
                    : List.<String>of();
            if (isServed(question)) {
                cancel(question, label + ": being served", event, in, question.open(), out, given);
            }
            if (question.isAccepted() && net.chosen().contains(question.provider())) {
                var gone = List.of(net.accepted().gone(question.caller(), question.target()));
                cancel(question, label + ": accepted", event, in, question.accepted(), out, gone);
            }
            cancel(question, label + ": answered", event, in, question.settled(), out, List.of());
            if (question.mayBeRejected()) {
                cancel(question, label + ": rejected", event, in, question.rejected(), out, List.of());
            }
            return;
        }
        var idle = net.chosen().contains(question.provider())
                ? List.of(idle(question.provider(), question.call()))
                : List.<String>of();
        for (var items = 0; items <= question.window(); items++) {
            var with = " with " + items + " items";
            flush(question, label + ": a stream" + with, event, in, question.open(), out, idle, items);
            flush(question, label + ": finished" + with, event, in, question.settled(), out, List.of(), items);
            if (question.mayBeRejected()) {
                flush(question, label + ": rejected" + with, event, in, question.rejected(), out, List.of(), items);
            }
        }
    }

    private void cancel(
            Question question,
            String label,
            Event event,
            List<String> in,
            String phase,
            List<String> out,
            List<String> more) {
        draft.step(label, event, joined(in, List.of(phase)), joined(joined(out, List.of(question.none())), more));
    }

    private void flush(
            Question question,
            String label,
            Event event,
            List<String> in,
            String phase,
            List<String> out,
            List<String> more,
            int items) {
        draft.step(
                label,
                event,
                joined(in, question.holding(items, phase)),
                joined(joined(out, question.holding(0, question.none())), more));
    }

    private static List<String> joined(List<String> one, List<String> other) {
        var joined = new ArrayList<>(one);
        joined.addAll(other);
        return joined;
    }

    /** The steps that emit into a stream, or finish it. */
    private void providerStep(String provider, Step step) {
        var call = switch (step) {
            case Step.Emits emits -> emits.call();
            case Step.Finishes finishes -> finishes.call();
            default -> "";
        };
        if (call.isEmpty()) {
            return;
        }
        var label = net.labels().label(provider, wiring.protocol(provider), step);
        var to = WiringNet.at(provider, step.to());
        var begun = step instanceof Step.Emits emits
                ? net.begun(provider, emits)
                : new WiringNet.Begun(
                        WiringNet.at(provider, step.from()), Event.of(provider).begins(provider, step));
        var event = begun.event().seen(step instanceof Step.Emits ? Kind.EMITTED : Kind.FINISHED, provider, call);
        var asking = asking(provider, call);
        if (asking.isEmpty()) {
            draft.step(label, event, List.of(begun.place()), List.of(to));
            return;
        }
        var idle = idle(provider, call);
        draft.step(label + " without a stream", event, List.of(begun.place(), idle), List.of(to, idle));
        for (var question : asking) {
            if (step instanceof Step.Emits) {
                draft.step(
                        label + " to " + question.caller(),
                        event,
                        List.of(begun.place(), question.open(), question.room()),
                        List.of(to, question.open(), question.item()));
            } else {
                draft.step(
                        label + " to " + question.caller(),
                        event,
                        List.of(begun.place(), question.open()),
                        List.of(to, question.settled(), idle));
            }
        }
    }
}
