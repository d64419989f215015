package io.troupe.services.bus;

import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.function.Function;

/**
 * One component's access to the bus.
 *
 * <p><b>Threads.</b> Any thread calls. What a subscriber or an answerer is given runs on the actor space on which it
 * was registered.
 *
 * <p><b>Order.</b> From one port to one subscriber, first in first out. At most once: a value is never delivered twice.
 *
 * <p><b>Errors.</b> Nothing is lost silently: what cannot be delivered is told to the bus's observer, and rejects a
 * question.
 */
public interface BusPort extends AutoCloseable {
    Address address();

    /** Sends a value to all who subscribe to the topic now. */
    <T extends Record> void publish(Topic<T> topic, T value);

    /** Hears what is published from now on; a subscription is closed by itself when this port is. */
    <T extends Record> Subscription subscribe(Topic<T> topic, Subscriber<? super T> subscriber);

    /** Answers questions from now on; an exception, or a rejected promise, rejects the question. */
    <Q extends Record, A extends Record> void answer(
            Operation<Q, A> operation, Function<? super Q, ? extends Promise<A>> answerer);

    /**
     * Asks. Once at most: nothing is repeated. The answerer is not told of the limit, nor that the asker has given up:
     * it works on the question all the same. A question that is cancelled is forgotten here.
     *
     * @param limit how long to wait, on the clock of the asker's space
     * @return the answer; rejected with a {@link BusException} if nobody is at the address, or nobody there answers
     *     that operation; with a {@link BusTimeoutException} if no answer comes within the limit (one that comes later
     *     is told to the bus's observer); with a {@link RemoteFailure} if the answerer fails
     */
    <Q extends Record, A extends Record> Promise<A> ask(
            Address to, Operation<Q, A> operation, Q question, Duration limit);

    /** Leaves the bus: the name is free again, subscriptions end, and questions that wait here are rejected. */
    @Override
    void close();

    /** Hears values. */
    @FunctionalInterface
    interface Subscriber<T> {
        void hear(T value, Address publisher);
    }

    /** Ends the hearing. */
    @FunctionalInterface
    interface Subscription extends AutoCloseable {
        @Override
        void close();
    }
}
