package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.common.text.Suggestions;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.function.IntFunction;
import java.util.stream.Stream;

/**
 * Collects the components and bindings of a {@link Wiring}.
 *
 * <p><b>Role.</b> From {@link Wiring#of}; continue with {@link #component} and {@link #bind}.
 *
 * <p><b>Threads.</b> Not thread-safe.
 *
 * <p><b>Errors.</b> An illegal or repeated name throws {@link IllegalArgumentException} at once; {@link #build} throws
 * it for errors that need the whole wiring.
 */
public final class WiringBuilder {
    private final String name;
    private final Wiring.Parts parts = Wiring.Parts.empty();

    WiringBuilder(String name) {
        this.name = requireNonNull(name, "name");
    }

    /** Adds a component with the name of its protocol. */
    public WiringBuilder component(Protocol protocol) {
        return component(protocol.name(), protocol);
    }

    /** Adds a component. */
    public WiringBuilder component(String component, Protocol protocol) {
        ProtocolBuilder.requireName(
                "wiring " + name + ": the name of a component", requireNonNull(component, "component"));
        requireNonNull(protocol, "protocol");
        require(!parts.components().containsKey(component), "there are two components called " + component);
        require(!parts.resources().containsKey(component), component + " is a component and a resource");
        parts.components().put(component, protocol);
        return this;
    }

    /** Adds {@code count} (1 or more) components named {@code prefix} followed by 1, 2, .. */
    public WiringBuilder components(String prefix, int count, Protocol protocol) {
        require(count > 0, "there are " + count + " components " + prefix + ", expected 1 or more");
        for (var i = 1; i <= count; i++) {
            component(prefix + i, protocol);
        }
        return this;
    }

    /** Binds the steps of {@code component} that name {@code role} to a component or resource, {@code provider}. */
    public WiringBuilder bind(String component, String role, String provider) {
        var key = requireNonNull(component, "component") + "." + requireNonNull(role, "role");
        requireNonNull(provider, "provider");
        var old = parts.bindings().put(key, provider);
        require(old == null, key + " is bound twice, to " + old + " and to " + provider);
        return this;
    }

    /**
     * Binds a role of each component that {@link #components} added with {@code prefix}; {@code provider} maps their
     * numbers, from 1, to components or resources.
     */
    public WiringBuilder bindEach(String prefix, String role, IntFunction<String> provider) {
        var number = 1;
        while (parts.components().containsKey(prefix + number)) {
            bind(prefix + number, role, provider.apply(number));
            number++;
        }
        require(
                number > 1,
                "there is no component " + prefix + "1; expected components(\"" + prefix + "\", ..) before");
        return this;
    }

    /**
     * Declares that a call or message, written {@code component.call}, comes from outside at any time, so that no
     * component needs to make or send it.
     */
    public WiringBuilder open(String target) {
        parts.open().add(requireNonNull(target, "target"));
        return this;
    }

    /** Declares the mailbox of a component that receives one-way messages: its {@code capacity}, 1 or more. */
    public WiringBuilder mailbox(String component, int capacity, Overflow overflow) {
        requireNonNull(component, "component");
        requireNonNull(overflow, "overflow");
        require(capacity > 0, "the mailbox of " + component + " has the capacity " + capacity + ", expected 1 or more");
        var old = parts.mailboxes().put(component, new Wiring.Mailbox(capacity, overflow));
        require(old == null, "the mailbox of " + component + " is declared twice");
        return this;
    }

    /** Adds a resource of {@code units}, 1 or more, each of which one component at a time may hold. */
    public WiringBuilder resource(String resource, int units) {
        ProtocolBuilder.requireName(
                "wiring " + name + ": the name of a resource", requireNonNull(resource, "resource"));
        require(units > 0, "resource " + resource + " has " + units + " units, expected 1 or more");
        require(!parts.components().containsKey(resource), resource + " is a component and a resource");
        require(parts.resources().put(resource, units) == null, "there are two resources called " + resource);
        return this;
    }

    /** Adds {@code count} resources of one unit named {@code prefix} followed by 1, 2, .. */
    public WiringBuilder resources(String prefix, int count) {
        require(count > 0, "there are " + count + " resources " + prefix + ", expected 1 or more");
        for (var i = 1; i <= count; i++) {
            resource(prefix + i, 1);
        }
        return this;
    }

    /** Sets how many items a stream, written {@code component.call}, holds before its provider waits; else 1. */
    public WiringBuilder window(String target, int items) {
        requireNonNull(target, "target");
        require(items > 0, "the window of " + target + " holds " + items + " items, expected 1 or more");
        require(parts.windows().put(target, items) == null, "the window of " + target + " is declared twice");
        return this;
    }

    /** Checks the declaration and builds the wiring. */
    public Wiring build() {
        require(!parts.components().isEmpty(), "there are no components; expected 1 or more");
        parts.bindings().forEach(this::requireBinding);
        var wiring = new Wiring(name, parts.copy(), Optional.empty());
        var incoming = new LinkedHashSet<String>();
        var streams = new LinkedHashSet<String>();
        parts.components().forEach((component, protocol) -> {
            protocol.outgoing().forEach(step -> requireAnswered(wiring, component, step));
            protocol.acquired().forEach(role -> requireResource(wiring, component, role));
            protocol.steps(Step.Ends.class).forEach(step -> requireNoQuestion(wiring, component, step.from()));
            protocol.provided().forEach(call -> incoming.add(component + "." + call));
            protocol.received().forEach(message -> incoming.add(component + "." + message));
            protocol.provided().stream()
                    .filter(protocol::isStream)
                    .forEach(call -> streams.add(component + "." + call));
            require(
                    protocol.received().isEmpty() || parts.mailboxes().containsKey(component),
                    component + " receives " + protocol.received() + ", but its mailbox has no capacity; expected"
                            + " mailbox(\"" + component + "\", 1, Overflow.BLOCK) or another one");
        });
        requireKnown("open call", "offered", parts.open(), incoming);
        requireKnown("window of", "a stream", parts.windows().keySet(), streams);
        parts.mailboxes().forEach((component, mailbox) -> requireMailbox(wiring, component, mailbox));
        parts.components().forEach((component, protocol) -> {
            protocol.provided().forEach(call -> requireCalled(wiring, component, call));
            protocol.received().forEach(message -> requireSent(wiring, component, message));
        });
        return wiring;
    }

    private void requireNoQuestion(Wiring wiring, String component, String state) {
        var open = requireNonNull(wiring.openQuestions(component).get(state));
        require(
                open.isEmpty(),
                component + " ends in state " + state + ", where its questions " + open
                        + " may be open; expected to take what comes back, or cancels(..), before");
    }

    private void requireMailbox(Wiring wiring, String component, Wiring.Mailbox mailbox) {
        requireComponent("the mailbox of " + component + " is declared", component);
        var received = wiring.protocol(component).received();
        require(
                !received.isEmpty(),
                component + " has a mailbox, but receives nothing; expected a state that receives a message");
        require(
                Mailboxes.contents(mailbox.capacity(), received.size()) <= Mailboxes.MAX_CONTENTS,
                "the mailbox of " + component + " with a capacity of " + mailbox.capacity() + " for " + received
                        + " has more than " + Mailboxes.MAX_CONTENTS + " contents; expected a smaller capacity");
    }

    private void requireKnown(String what, String known, Set<String> targets, Set<String> all) {
        for (var target : targets) {
            require(
                    all.contains(target),
                    what + " " + target + " is not " + known + "; " + Suggestions.hintWithAll(target, all));
        }
    }

    private void requireComponent(String what, String component) {
        require(
                parts.components().containsKey(component),
                what + ", but there is no component " + component + "; "
                        + Suggestions.hintWithAll(component, parts.components().keySet()));
    }

    private void requireBinding(String key, String provider) {
        var component = key.substring(0, key.indexOf('.'));
        var role = key.substring(key.indexOf('.') + 1);
        requireComponent(key + " is bound", component);
        var protocol = requireNonNull(parts.components().get(component));
        var callees = protocol.outgoing().map(Step.Outgoing::role).distinct().toList();
        var roles = Stream.concat(callees.stream(), protocol.acquired().stream())
                .distinct()
                .toList();
        require(
                roles.contains(role),
                key + " is bound, but " + component + " requests nothing of " + role + "; "
                        + Suggestions.hintWithAll(role, roles));
        var known = callees.contains(role)
                ? parts.components().keySet()
                : parts.resources().keySet();
        require(
                known.contains(provider),
                key + " is bound to the unknown " + (callees.contains(role) ? "component " : "resource ") + provider
                        + "; " + Suggestions.hintWithAll(provider, known));
    }

    private void requireResource(Wiring wiring, String component, String role) {
        var resource = wiring.bound(component, role);
        require(
                parts.resources().containsKey(resource),
                component + " acquires " + role + ", but there is no resource " + resource + "; "
                        + Suggestions.hintWithAll(resource, parts.resources().keySet()));
    }

    private void requireAnswered(Wiring wiring, String component, Step.Outgoing step) {
        if (step instanceof Step.Takes || step instanceof Step.Cancels) {
            return; // of a question that is checked
        }
        var provider = wiring.provider(component, step);
        var verb = switch (step) {
            case Step.Sends sends -> " sends ";
            case Step.Asks asks -> " asks ";
            default -> " requests ";
        };
        var target = component + verb + step.target() + " in state " + step.from();
        requireComponent(target, provider);
        var protocol = requireNonNull(parts.components().get(provider));
        require(!provider.equals(component), target + " of itself; expected another component");
        var known = step instanceof Step.Sends ? protocol.received() : protocol.provided();
        require(
                known.contains(step.call()),
                target + ", but " + provider + (step instanceof Step.Sends ? " never receives " : " never offers ")
                        + step.call() + "; " + Suggestions.hintWithAll(step.call(), known));
        switch (step) {
            case Step.Requests request -> {
                require(
                        !protocol.isStream(step.call()),
                        target + ", which is a stream; expected asks(\"" + step.target() + "\")");
                require(
                        request.onRejection().isPresent() == protocol.mayReject(step.call()),
                        target
                                + (request.onRejection().isPresent()
                                        ? " or is rejected, but " + provider
                                                + " never rejects it; expected no orRejected"
                                        : ", which " + provider + " may reject; expected orRejected(STATE)"));
            }
            case Step.Asks asks -> requireOutcomes(component, target, asks, provider, protocol);
            case Step.Sends sends ->
                require(
                        sends.onRejection().isEmpty()
                                || wiring.mailbox(provider)
                                        .filter(box -> box.overflow() == Overflow.REJECT)
                                        .isPresent(),
                        target + " or is rejected, but the mailbox of " + provider
                                + " never rejects; expected Overflow.REJECT");
            default -> {}
        }
    }

    /** Checks that the caller takes everything that may come back for a question, and nothing else. */
    private void requireOutcomes(String component, String target, Step.Asks asks, String provider, Protocol protocol) {
        for (var outcome : Step.Takes.Outcome.values()) {
            var isTaken = requireNonNull(parts.components().get(component))
                    .steps(Step.Takes.class)
                    .anyMatch(takes ->
                            takes.outcome() == outcome && takes.target().equals(asks.target()));
            var mayCome = switch (outcome) {
                case ANSWER -> true;
                case REJECTION -> protocol.mayReject(asks.call());
                case END ->
                    protocol.steps(Step.Finishes.class)
                            .anyMatch(step -> step.call().equals(asks.call()));
            };
            var step = switch (outcome) {
                case ANSWER -> "answered";
                case REJECTION -> "rejected";
                case END -> "finished";
            };
            require(
                    isTaken == mayCome,
                    target + ", "
                            + (mayCome
                                    ? "but no state takes what may come back; expected "
                                    : "but " + provider + " never sends what is taken by ")
                            + step + "(\"" + asks.target() + "\")");
        }
    }

    private void requireCalled(Wiring wiring, String component, String call) {
        requireUsed(
                component,
                "offers",
                call,
                "requests",
                wiring.callers(component, call, parts.components().keySet()));
    }

    private void requireSent(Wiring wiring, String component, String message) {
        requireUsed(
                component,
                "receives",
                message,
                "sends",
                wiring.senders(component, message, parts.components().keySet()));
    }

    private void requireUsed(String component, String offers, String call, String verb, List<String> users) {
        var declaredOpen = parts.open().contains(component + "." + call);
        require(
                !users.isEmpty() || declaredOpen,
                component + " " + offers + " " + call + ", but no component " + verb + " it; "
                        + verb.substring(0, verb.length() - 1) + " it, or declare " + component + "." + call + " open");
        require(
                users.isEmpty() || !declaredOpen,
                component + "." + call + " is declared open and " + (verb.equals("sends") ? "sent" : "requested")
                        + " by " + users + "; expected one of the two");
    }

    private void require(boolean condition, String message) {
        if (!condition) {
            throw error(message);
        }
    }

    private IllegalArgumentException error(String message) {
        return new IllegalArgumentException("wiring " + name + ": " + message);
    }
}
