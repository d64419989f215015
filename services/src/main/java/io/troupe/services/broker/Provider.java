package io.troupe.services.broker;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import org.jspecify.annotations.Nullable;

/**
 * How the broker runs what provides a service: a component's interface, or an actor.
 *
 * <p><b>Threads.</b> Called on the broker's space; it answers from wherever it lives. The broker limits how long it
 * waits.
 *
 * <p><b>Order.</b> A start begins when the stop before it is answered, or its limit is over. What has failed while it
 * ran, or has not started within its limit, is told to stop, so that it does not run beside whoever takes its place;
 * and once more if its start is answered after that. A start that is answered while a later one goes on counts as one
 * life with it.
 *
 * <p><b>Errors.</b> A provider that has a time limit of its own rejects with {@link ProviderException#overdue} when
 * that is over, since it may still do what it was asked for: any other rejection of a start is not followed by a stop,
 * and any other rejected check makes it failed at once.
 */
public interface Provider {
    /** Fulfilled when it runs; called again after {@link #stop} or a failure. */
    Promise<@Nullable Void> start();

    /** Fulfilled when it has stopped. */
    Promise<@Nullable Void> stop();

    /** Fulfilled when it is well, rejected with what is wrong with it. Never fulfilled by something that hangs. */
    Promise<@Nullable Void> check();

    /**
     * Settled when what runs now ends by itself, so that the broker hears at once; asked for after every start. One
     * that cannot tell answers a promise that is never settled, as this method does: then only {@link #check} finds
     * out.
     */
    default Promise<@Nullable Void> whenEnded() {
        return new Deferred<>(null);
    }
}
