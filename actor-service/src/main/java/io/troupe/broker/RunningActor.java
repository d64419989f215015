package io.troupe.broker;

import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.internal.loop.QueueEntry;
import io.troupe.bus.Address;
import java.time.Duration;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import org.jspecify.annotations.Nullable;

/**
 * One running instance of an actor that provides a service, in this process or in another one. Used from any thread.
 */
abstract class RunningActor {
    private final Address address;
    private final Set<Deferred<@Nullable Void>> watches = ConcurrentHashMap.newKeySet();

    RunningActor(Address address) {
        this.address = address;
    }

    /** A call could not be sent. */
    static final class NotSentException extends Exception {
        private static final long serialVersionUID = 1L;

        NotSentException(Throwable why) {
            super(why);
        }

        Throwable why() {
            return getCause();
        }
    }

    final Address address() {
        return address;
    }

    abstract boolean hasEnded();

    /** Returns what it is or lacks, if it cannot be called by that interface; null if it can. */
    abstract @Nullable String mismatch(Class<?> type);

    /**
     * Sends a call.
     *
     * @param type the interface that was called
     * @param call a message or a request
     * @param remote sends it to another process
     * @param limit the longest time until the answer; null = no limit
     * @return the answer; null for a one-way call
     */
    abstract @Nullable Promise<?> send(Class<?> type, QueueEntry call, RemoteCaller remote, @Nullable Duration limit)
            throws NotSentException;

    /** The value of an answer. */
    abstract @Nullable Object result(Class<?> type, QueueEntry call, @Nullable Object answer);

    /**
     * Watches for the end of this instance.
     *
     * @return fulfilled when the instance ends. Pass it to {@link #unwatch} when it is no longer needed, because
     *     connections are opened and closed while a provider runs
     */
    final Deferred<@Nullable Void> watch() {
        var watch = new Deferred<@Nullable Void>();
        watches.add(watch);
        if (isOver()) {
            watch.resolve(null);
        }
        return watch;
    }

    /** Returns whether watches are settled: the instance has ended, and will not answer. */
    abstract boolean isOver();

    final void unwatch(Deferred<@Nullable Void> watch) {
        watches.remove(watch);
    }

    /** Called after {@link #isOver} has become true. */
    final void settleWatches() {
        watches.forEach(watch -> watch.resolve(null));
        watches.clear();
    }
}
