package io.troupe.services.broker;

import io.troupe.actor.promise.Promise;
import org.jspecify.annotations.Nullable;

/**
 * How the broker runs what provides a service: a component's interface, or an actor.
 *
 * <p><b>Threads.</b> Called on the broker's space; it answers from wherever it lives. The broker limits how long it waits.
 */
public interface Provider {
    /** Fulfilled when it runs; called again after {@link #stop} or a failure. */
    Promise<@Nullable Void> start();

    /** Fulfilled when it has stopped. */
    Promise<@Nullable Void> stop();

    /** Fulfilled when it is well, rejected with what is wrong with it. Never fulfilled by something that hangs. */
    Promise<@Nullable Void> check();
}
