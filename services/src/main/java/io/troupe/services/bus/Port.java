package io.troupe.services.bus;

import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Set;
import java.util.function.Function;
import org.jspecify.annotations.Nullable;

/** A port of a node: its subscriptions, request handlers and topics. */
final class Port implements BusPort {
    final BusNode node;
    private final Address address;
    private final Object lock = new Object(); // guards all fields below
    private final Set<Hearing<?>> hearings = new LinkedHashSet<>();
    private final Map<String, Answering<?, ?>> answerings = new LinkedHashMap<>();
    private final Set<Topic<?>> topics = new HashSet<>(); // those it has published or subscribed to
    private @Nullable String closed;

    Port(BusNode node, Address address) {
        this.node = node;
        this.address = address;
    }

    @Override
    public Address address() {
        return address;
    }

    @Override
    public <T extends Record> void publish(Topic<T> topic, T value) {
        Record payload = node.detached(topic.type().cast(Objects.requireNonNull(value, "value")));
        synchronized (lock) {
            if (closed != null) {
                throw refusal("publish on " + topic.name(), closed);
            }
            use(topic); // after the check of the value: a rejected value does not fix the topic's type
        }
        node.publish(this, topic, payload);
    }

    @Override
    public <T extends Record> Subscription subscribe(Topic<T> topic, Subscriber<? super T> subscriber) {
        Objects.requireNonNull(subscriber, "subscriber");
        var hearing = new Hearing<T>(this, topic, subscriber);
        synchronized (lock) {
            if (closed != null) {
                throw refusal("subscribe to " + topic.name(), closed);
            }
            use(topic);
            hearings.add(hearing);
        }
        hearing.open();
        node.add(hearing);
        checkBegun("subscribe to " + topic.name(), hearing);
        return hearing;
    }

    @Override
    public <Q extends Record, A extends Record> void answer(
            Operation<Q, A> operation, Function<? super Q, ? extends Promise<A>> answerer) {
        Objects.requireNonNull(answerer, "answerer");
        var answering = new Answering<Q, A>(this, operation, answerer);
        var before = answering(operation.name());
        if (before != null && !before.isOver()) {
            throw answeredAlready(operation);
        }
        answering.open();
        synchronized (lock) {
            if (closed != null) {
                answering.end(closed);
            } else if (answerings.putIfAbsent(operation.name(), answering) != null) {
                answering.end("another answers");
                throw answeredAlready(operation);
            }
        }
        checkBegun("answer " + operation.name(), answering);
    }

    private IllegalArgumentException answeredAlready(Operation<?, ?> operation) {
        return new IllegalArgumentException(address + " answers " + operation.name() + " already");
    }

    /** Throws if the queue has ended before it was registered, because its space or this port was closed. */
    private void checkBegun(String what, Inlet inlet) {
        String why = inlet.whyEnded();
        if (why != null) {
            forget(inlet);
            throw refusal(what, why);
        }
    }

    @Override
    public <Q extends Record, A extends Record> Promise<A> ask(
            Address to, Operation<Q, A> operation, Q question, Duration limit) {
        return node.ask(this, to, operation, question, limit);
    }

    @Override
    public void close() {
        close("it has left the bus");
    }

    void close(String why) {
        List<Inlet> inlets = new ArrayList<>();
        synchronized (lock) {
            if (closed != null) {
                return;
            }
            closed = why;
            topics.forEach(node::release);
            topics.clear();
            inlets.addAll(hearings);
            inlets.addAll(answerings.values());
        }
        node.detach(this);
        inlets.forEach(inlet -> inlet.end(why));
        node.rejectQuestionsOf(this, "the asker has left: " + why);
    }

    @Nullable
    String whyClosed() {
        synchronized (lock) {
            return closed;
        }
    }

    @Nullable
    Answering<?, ?> answering(String operation) {
        synchronized (lock) {
            return answerings.get(operation);
        }
    }

    List<String> operations() {
        synchronized (lock) {
            return List.copyOf(answerings.keySet());
        }
    }

    /** Removes a queue that has ended. */
    void forget(Inlet inlet) {
        synchronized (lock) {
            switch (inlet) {
                case Hearing<?> hearing -> hearings.remove(hearing);
                case Answering<?, ?> answering -> answerings.remove(answering.operation.name(), answering);
                default -> throw new IllegalStateException("no such inlet: " + inlet);
            }
        }
        if (inlet instanceof Hearing<?> hearing) {
            node.remove(hearing);
        }
    }

    /** Called under the lock. */
    private void use(Topic<?> topic) {
        if (!topics.contains(topic)) {
            node.use(topic);
            topics.add(topic);
        }
    }

    private BusException refusal(String what, String why) {
        return new BusException(address + " cannot " + what + ": " + why);
    }

    @Override
    public String toString() {
        return address.toString();
    }
}
