package io.troupe.bus;

import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.function.Function;

/**
 * The access of one component to the bus.
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
public interface BusPort extends AutoCloseable {
    Address address();

    /** Publishes a value to all current subscribers of the topic. */
    <T extends Record> void publish(BusTopic<T> topic, T value);

    /**
     * Subscribes to the values published from now on. The subscription ends when it is closed or when this port is
     * closed.
     */
    <T extends Record> Subscription subscribe(BusTopic<T> topic, Subscriber<? super T> subscriber);

    /**
     * Registers the request handler of an operation. An exception from the handler, or a rejected promise, rejects the
     * request.
     */
    <Q extends Record, A extends Record> void answer(
            Operation<Q, A> operation, Function<? super Q, ? extends Promise<A>> handler);

    /**
     * Sends a request. At most once: a request is never sent again. The request handler does not learn the limit, and
     * is not notified when the requester gives up: it completes its work. If the returned promise is cancelled, the
     * reply is no longer awaited.
     *
     * @param limit the time limit, on the clock of the requester's space
     * @return the reply; rejected with a {@link BusException} if the address has no port, or the port has no handler
     *     for that operation; with a {@link BusTimeoutException} if no reply arrives within the limit (a later reply is
     *     reported to the bus's observer); with a {@link RemoteFailure} if the handler fails
     */
    <Q extends Record, A extends Record> Promise<A> ask(
            Address to, Operation<Q, A> operation, Q request, Duration limit);

    /** Leaves the bus: the name becomes free, subscriptions end, and queued and pending requests are rejected. */
    @Override
    void close();

    /** Receives the values of a subscription. */
    @FunctionalInterface
    interface Subscriber<T> {
        void receive(T value, Address publisher);
    }

    /** A subscription to a topic; closing it ends it. */
    @FunctionalInterface
    interface Subscription extends AutoCloseable {
        @Override
        void close();
    }
}
