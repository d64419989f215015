package io.troupe.petri.wiring;

import io.troupe.petri.wiring.ProtocolEvent.Kind;
import io.troupe.petri.wiring.WiringNet.Event;
import java.util.ArrayList;
import java.util.List;

/**
 * One-way messages: a place for each content of a mailbox, so that the order of the messages is exact, and so is what
 * is dropped.
 */
final class Mailboxes {
    /** The most contents that a mailbox may have. */
    static final int MAX_CONTENTS = 1000;

    private final WiringNet net;
    private final Wiring wiring;

    Mailboxes(WiringNet net) {
        this.net = net;
        wiring = net.wiring();
    }

    /** The number of contents of a mailbox, or one more than the most if there are more. */
    static int contents(int capacity, int messages) {
        var contents = 1L;
        var longest = 1L;
        for (var i = 0; i < capacity && contents <= MAX_CONTENTS; i++) {
            longest *= messages;
            contents += longest;
        }
        return (int) Math.min(contents, MAX_CONTENTS + 1L);
    }

    /** Adds the mailbox of a component, what it takes out of it, and what it sends to others. */
    void add(String component) {
        wiring.mailbox(component).ifPresent(mailbox -> {
            var received = wiring.protocol(component).received();
            for (var content : contents(mailbox, received)) {
                net.draft()
                        .place(
                                place(component, content),
                                content.isEmpty() ? 1 : 0,
                                new WiringNet.ComponentState.Holding(component, content));
                receive(component, content);
            }
            received.forEach(message -> fromOutside(component, mailbox, message));
        });
        wiring.protocol(component).steps(Step.Sends.class).forEach(step -> send(component, step));
    }

    private void receive(String component, List<String> content) {
        var protocol = wiring.protocol(component);
        for (var step : protocol.steps(Step.Receives.class).toList()) {
            if (!content.isEmpty() && content.get(0).equals(step.call())) {
                var rest = content.subList(1, content.size());
                net.draft()
                        .step(
                                net.labels().label(component, protocol, step) + " of " + content,
                                Event.of(component).begins(component, step).seen(Kind.RECEIVED, component, step.call()),
                                List.of(WiringNet.at(component, step.from()), place(component, content)),
                                List.of(WiringNet.at(component, step.to()), place(component, rest)));
            }
        }
    }

    private void fromOutside(String receiver, Wiring.Mailbox mailbox, String message) {
        if (!net.comesFromOutside(receiver, message)) {
            return;
        }
        for (var content : contents(mailbox, wiring.protocol(receiver).received())) {
            var isFull = content.size() == mailbox.capacity();
            if (!isFull || mailbox.overflow() == Overflow.DROP_OLDEST) {
                net.draft()
                        .step(
                                "a sender outside sends " + receiver + "." + message + " to " + content,
                                Event.of().seen(Kind.ARRIVED, receiver, message),
                                List.of(place(receiver, content)),
                                List.of(place(receiver, after(content, message, mailbox))));
            }
        }
    }

    private void send(String sender, Step.Sends step) {
        var receiver = wiring.provider(sender, step);
        var label = net.labels().label(sender, wiring.protocol(sender), step);
        var from = WiringNet.at(sender, step.from());
        var to = WiringNet.at(sender, step.to());
        if (!net.chosen().contains(receiver)) {
            net.draft().step(label, sender, List.of(from), List.of(to));
            net.outside(sender, label + " and is rejected", from, step.onRejection());
            return;
        }
        var mailbox = wiring.mailbox(receiver).orElseThrow();
        var begun = net.begun(sender, step);
        for (var content : contents(mailbox, wiring.protocol(receiver).received())) {
            var isFull = content.size() == mailbox.capacity();
            if (isFull && mailbox.overflow() == Overflow.BLOCK) {
                continue;
            }
            var isRejected = isFull && mailbox.overflow() == Overflow.REJECT;
            var ending = !isFull ? "" : isRejected ? ", which rejects it" : ", which drops " + content.get(0);
            var state = isRejected
                    ? step.onRejection()
                            .map(other -> WiringNet.at(sender, other))
                            .orElse(to)
                    : to;
            net.draft()
                    .step(
                            label + " to " + content + ending,
                            begun.event()
                                    .seen(isRejected ? Kind.REFUSED : Kind.SENT, sender, receiver + "." + step.call()),
                            List.of(begun.place(), place(receiver, content)),
                            List.of(
                                    state,
                                    place(receiver, isRejected ? content : after(content, step.call(), mailbox))));
        }
    }

    private static List<String> after(List<String> content, String message, Wiring.Mailbox mailbox) {
        var after = new ArrayList<>(content);
        after.add(message);
        return after.size() <= mailbox.capacity() ? after : after.subList(1, after.size());
    }

    /** All contents, shortest first. */
    private static List<List<String>> contents(Wiring.Mailbox mailbox, List<String> messages) {
        var all = new ArrayList<List<String>>();
        all.add(List.of());
        for (var i = 0; i < all.size() && all.get(i).size() < mailbox.capacity(); i++) {
            for (var message : messages) {
                var longer = new ArrayList<>(all.get(i));
                longer.add(message);
                all.add(longer);
            }
        }
        return all;
    }

    static String place(String component, List<String> content) {
        return component + "'s mailbox " + content;
    }
}
