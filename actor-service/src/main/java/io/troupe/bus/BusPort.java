package io.troupe.bus;

import io.troupe.actor.Promise;
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

/**
 * The access of one component to the bus.
 *
 * {@snippet :
 * display.subscribe(OUTSIDE, (temperature, from) -> show(from + ": " + temperature.celsius()));
 * sensor.publish(OUTSIDE, new Temperature(-3));
 *
 * bus.attach("heating").answer(HEAT, setpoint -> Promise.of(new Accepted(setpoint.celsius() > 15)));
 * var heating = new Address("house", "heating");
 * var limit = Duration.ofSeconds(1);
 * display.ask(heating, HEAT, new Setpoint(21), limit).then(accepted -> show(accepted.heats()));
 * }
 *
 * <p><b>Threads.</b> Methods may be called from any thread. A subscriber or a request handler runs on the actor space
 * on which it was registered.
 *
 * <p><b>Order.</b> First in, first out, from one port to one subscriber. At most once: a value is never delivered
 * twice.
 *
 * <p><b>Errors.</b> Nothing is lost silently: a message that cannot be delivered is reported to the bus's observer, and
 * a request that cannot be delivered is rejected.
 */
public final class BusPort implements AutoCloseable {
    /** Receives the values of a subscription. */
    @FunctionalInterface
    public interface Subscriber<T> {
        void receive(T value, Address publisher);
    }

    /** A subscription to a topic; closing it ends it. */
    @FunctionalInterface
    public interface Subscription extends AutoCloseable {
        @Override
        void close();
    }

    final Bus node;
    private final Address address;
    private final Object lock = new Object(); // guards all fields below
    private final Set<TopicSubscription<?>> subscriptions = new LinkedHashSet<>();
    private final Map<String, OperationHandler<?, ?>> operationHandlers = new LinkedHashMap<>();
    private final Set<BusTopic<?>> topics = new HashSet<>(); // those it has published or subscribed to
    private @Nullable String closed;

    BusPort(Bus node, Address address) {
        this.node = node;
        this.address = address;
    }

    /** The address of this port. */
    public Address address() {
        return address;
    }

    /** Publishes a value to all current subscribers of the topic. */
    public <T extends Record> void publish(BusTopic<T> topic, T value) {
        publish(topic, value, 0);
    }

    /** @param ageNanos how old the value is already */
    <T extends Record> void publish(BusTopic<T> topic, T value, long ageNanos) {
        Record payload = node.copy(topic.type().cast(Objects.requireNonNull(value, "value")));
        synchronized (lock) {
            if (closed != null) {
                throw rejection("publish on " + topic.name(), closed);
            }
            use(topic); // after the check of the value: a rejected value does not fix the topic's type
        }
        node.publish(this, topic, payload, ageNanos);
    }

    /**
     * Subscribes to the values published from now on. The subscription ends when it is closed or when this port is
     * closed.
     */
    public <T extends Record> Subscription subscribe(BusTopic<T> topic, Subscriber<? super T> subscriber) {
        Objects.requireNonNull(subscriber, "subscriber");
        return subscribe(new TopicSubscription<T>(this, topic, subscriber, null));
    }

    /**
     * Publishes the values of a topic on another one, until the subscription is closed. A value keeps its age, so that
     * one that is held up anywhere on its way is dropped by the greatest age of the last topic.
     *
     * {@snippet :
     * hub.forward(DRIVE, wheels, (velocity, from) -> show(from + ": " + velocity.forwardMps()));
     * }
     *
     * @param listener receives each value before it is published again
     */
    public <T extends Record> Subscription forward(BusTopic<T> from, BusTopic<T> to, Subscriber<? super T> listener) {
        Objects.requireNonNull(to, "to");
        Objects.requireNonNull(listener, "listener");
        return subscribe(new TopicSubscription<T>(this, from, listener, to));
    }

    private <T extends Record> Subscription subscribe(TopicSubscription<T> subscription) {
        BusTopic<T> topic = subscription.topic;
        synchronized (lock) {
            if (closed != null) {
                throw rejection("subscribe to " + topic.name(), closed);
            }
            use(topic);
            subscriptions.add(subscription);
        }
        subscription.open();
        node.add(subscription);
        checkOpen("subscribe to " + topic.name(), subscription);
        return subscription;
    }

    /**
     * Registers the request handler of an operation. An exception from the handler, or a rejected promise, rejects the
     * request.
     */
    public <Q extends Record, A extends Record> void answer(
            Operation<Q, A> operation, Function<? super Q, ? extends Promise<A>> handler) {
        Objects.requireNonNull(handler, "answerer");
        var operationHandler = new OperationHandler<Q, A>(this, operation, handler);
        var before = operationHandler(operation.name());
        if (before != null && !before.hasEnded()) {
            throw answeredAlready(operation);
        }
        operationHandler.open();
        synchronized (lock) {
            if (closed != null) {
                operationHandler.end(closed);
            } else if (operationHandlers.putIfAbsent(operation.name(), operationHandler) != null) {
                operationHandler.end("another answers");
                throw answeredAlready(operation);
            }
        }
        checkOpen("answer " + operation.name(), operationHandler);
    }

    private IllegalArgumentException answeredAlready(Operation<?, ?> operation) {
        return new IllegalArgumentException(address + " answers " + operation.name() + " already");
    }

    /** Throws if the queue has ended before it was registered, because its space or this port was closed. */
    private void checkOpen(String what, InboundQueue queue) {
        String why = queue.whyEnded();
        if (why != null) {
            forget(queue);
            throw rejection(what, why);
        }
    }

    /**
     * Sends a request. At most once: a request is never sent again. If the returned promise is cancelled, or the limit
     * is over, a request that is still queued is not handled; a handler that has begun completes its work, and its
     * reply is no longer awaited. Another node learns the limit with the request, so that this holds even if it cannot
     * be notified.
     *
     * @param limit the time limit, on the clock of the requester's space; null = no limit: if a frame of the request or
     *     its reply is lost, the promise is only settled by cancelling it
     * @return the reply; rejected with a {@link BusException} if the address has no port, or the port has no handler
     *     for that operation; with a {@link BusTimeoutException} if no reply arrives within the limit (a later reply is
     *     reported to the bus's observer); with a {@link RemoteFailure} if the handler fails
     */
    public <Q extends Record, A extends Record> Promise<A> ask(
            Address to, Operation<Q, A> operation, Q request, @Nullable Duration limit) {
        return node.ask(this, to, operation, request, limit);
    }

    /**
     * Sends a one-way message to the handler of an operation. At most once. Its result is not sent back; if it fails,
     * that is reported to the observer on its node. If the message cannot be delivered, that is reported to the
     * observer of the node that learns of it.
     */
    public <Q extends Record> void send(Address to, Operation<Q, ?> operation, Q value) {
        Record payload = node.copy(operation.request().cast(Objects.requireNonNull(value, "value")));
        String over = whyClosed();
        if (over != null) {
            throw rejection("send " + operation.name(), over);
        }
        node.notice(this, to, operation, payload);
    }

    /** Leaves the bus: the name becomes free, subscriptions end, and queued and pending requests are rejected. */
    @Override
    public void close() {
        close("it has left the bus");
    }

    void close(String why) {
        List<InboundQueue> queues = new ArrayList<>();
        synchronized (lock) {
            if (closed != null) {
                return;
            }
            closed = why;
            topics.forEach(topic -> node.release(this, topic));
            topics.clear();
            queues.addAll(subscriptions);
            queues.addAll(operationHandlers.values());
        }
        node.detach(this);
        queues.forEach(queue -> queue.end(why));
        node.rejectRequestsOf(this, "the port of the requester was closed: " + why);
    }

    @Nullable
    String whyClosed() {
        synchronized (lock) {
            return closed;
        }
    }

    @Nullable
    OperationHandler<?, ?> operationHandler(String operation) {
        synchronized (lock) {
            return operationHandlers.get(operation);
        }
    }

    /** That life of another node has ended: its requests are not awaited any more. */
    void forgetRequestsOf(String node, long incarnation) {
        List<OperationHandler<?, ?>> handlers;
        synchronized (lock) {
            handlers = List.copyOf(operationHandlers.values());
        }
        handlers.forEach(handler -> handler.forgetAllOf(node, incarnation));
    }

    List<String> operations() {
        synchronized (lock) {
            return List.copyOf(operationHandlers.keySet());
        }
    }

    /** Removes a queue that has ended. */
    void forget(InboundQueue queue) {
        synchronized (lock) {
            switch (queue) {
                case TopicSubscription<?> subscription -> subscriptions.remove(subscription);
                case OperationHandler<?, ?> operationHandler ->
                    operationHandlers.remove(operationHandler.operation.name(), operationHandler);
                default -> throw new IllegalStateException("no such queue: " + queue);
            }
        }
        if (queue instanceof TopicSubscription<?> subscription) {
            node.remove(subscription);
        }
    }

    /** Called under the lock. */
    private void use(BusTopic<?> topic) {
        if (!topics.contains(topic)) {
            node.use(topic);
            topics.add(topic);
        }
    }

    private BusException rejection(String what, String why) {
        return new BusException(address + " cannot " + what + ": " + why);
    }

    @Override
    public String toString() {
        return address.toString();
    }
}
