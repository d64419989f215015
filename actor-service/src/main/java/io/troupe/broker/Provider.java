package io.troupe.broker;

import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import org.jspecify.annotations.Nullable;

/**
 * A provider of a service, as the broker runs it: a component's interface, or an actor.
 *
 * {@snippet :
 * public Promise<@Nullable Void> start() {
 *     shown.add("camera starts");
 *     return Promise.done();
 * }
 *
 * public Promise<@Nullable Void> stop() {
 *     shown.add("camera stops");
 *     return Promise.done();
 * }
 *
 * public Promise<@Nullable Void> check() {
 *     return Promise.done();
 * }
 * }
 *
 * <p><b>Threads.</b> Called on the broker's space; may answer from any thread. The broker limits the time of each call.
 *
 * <p><b>Order.</b> A start begins after the answer to the previous stop, or after its limit. The broker calls stop for
 * a provider that failed while it ran, or did not start within its limit, so that it does not run beside its successor;
 * and again if such a start completes later. If a start completes while a later start is in progress, both count as one
 * run. A provider that is registered with an object for each life ({@link Broker#register(String, java.util.List,
 * io.troupe.bus.Address, java.util.function.Supplier)}) is started once; no life of it begins before the stops of all
 * earlier ones have been fulfilled.
 *
 * <p><b>Errors.</b> If a provider has a time limit itself, it rejects with {@link ProviderException#overdue} when that
 * is over, because the operation may still complete. If it fails, and a part of it may still run, it rejects with
 * {@link ProviderException#mayStillRun}. After any other rejection of a start, or of {@link #whenEnded}, stop is not
 * called; any rejected check that is not overdue makes the provider failed at once.
 */
public interface Provider {
    /** Starts it; fulfilled when it runs. Called again after {@link #stop} or a failure. */
    Promise<@Nullable Void> start();

    /** Stops it; fulfilled when it has stopped. */
    Promise<@Nullable Void> stop();

    /**
     * The health check: fulfilled if it is healthy, rejected with the problem if not. A provider that hangs never
     * settles it.
     */
    Promise<@Nullable Void> check();

    /**
     * Settled when the current run ends without {@link #stop}, so that the broker detects this at once. Called after
     * every start. A provider that cannot detect its end returns a promise that is never settled, as this method does;
     * then only {@link #check} detects it.
     */
    default Promise<@Nullable Void> whenEnded() {
        return Deferred.unbound();
    }
}
