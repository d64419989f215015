package io.troupe.actor;

import io.troupe.actor.internal.loop.QueueEntries;
import io.troupe.actor.internal.loop.QueueEntry;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/** The settled states of a promise that are not the value itself; see the table in {@link Settleable}. */
abstract class SettledState {
    /** Wraps a value that would be mistaken for another state. */
    static final class Boxed extends SettledState {
        private final Object value;

        Boxed(Object value) {
            this.value = value;
        }

        Object value() {
            return value;
        }
    }

    /** The error of a rejected promise, and whether a listener received it. */
    static final class Rejection extends SettledState {
        private final Throwable error;
        private volatile boolean handled;

        Rejection(Throwable error) {
            this.error = error;
        }

        Throwable error() {
            return error;
        }

        void markHandled() {
            handled = true;
        }

        boolean isHandled() {
            return handled;
        }
    }

    /**
     * The state of a promise that was settled by a thread other than that of some listener. While its listeners are
     * being notified, a late listener is appended to the queue. After that, until every listener has run, later
     * listeners go through the inbox of their home as the earlier ones did: an entry that the home queues for itself
     * would overtake them.
     */
    static final class PendingNotification extends SettledState {
        private final Object outcome;
        private final AtomicReference<@Nullable QueueEntry> late = new AtomicReference<>();
        private final AtomicInteger onTheirWay = new AtomicInteger();
        private final End end = new End(this); // made in advance, so that nothing is missing once it is settled

        PendingNotification(Object outcome, QueueEntry listeners) {
            this.outcome = outcome;
            for (QueueEntry node = listeners; node != null; node = QueueEntries.next(node)) {
                if (node instanceof Stage) {
                    onTheirWay.incrementAndGet();
                }
            }
        }

        /** The listeners, newest first, with the end in front of them. */
        QueueEntry end(QueueEntry listeners) {
            QueueEntries.link(end, listeners);
            return end;
        }

        /** Counts a listener that has not run yet; true if there are others. */
        boolean countListener(QueueEntry listener) {
            return listener instanceof Stage && onTheirWay.getAndIncrement() > 0;
        }

        /** Called when a listener runs. */
        void listenerRuns() {
            onTheirWay.decrementAndGet();
        }

        /** True if the home of some listener may be running concurrently with the calling thread. */
        static boolean isNeeded(QueueEntry newest) {
            for (QueueEntry node = newest; node != null; node = QueueEntries.next(node)) {
                if (node instanceof Stage<?, ?> stage && stage.isElsewhere()) {
                    return true;
                }
            }
            return false;
        }

        Object outcome() {
            return outcome;
        }

        /** Appends a late listener; false once all listeners have been notified. */
        boolean append(QueueEntry listener) {
            while (true) {
                QueueEntry now = late.get();
                if (now == Settleable.AlreadySettled.INSTANCE) {
                    return false;
                }
                QueueEntries.link(listener, now);
                if (late.compareAndSet(now, listener)) {
                    return true;
                }
            }
        }

        /** The last entry of the queue: closes it, or lets late listeners go first. */
        static final class End extends QueueEntry {
            private final PendingNotification notification;

            private End(PendingNotification notification) {
                this.notification = notification;
            }

            /**
             * The late listeners, newest first, with this end behind them. If there are none, closes the queue and
             * returns null.
             */
            @Nullable
            QueueEntry closeOrTakeLate() {
                if (notification.late.compareAndSet(null, Settleable.AlreadySettled.INSTANCE)) {
                    return null;
                }
                QueueEntries.link(this, notification.late.getAndSet(null));
                return this;
            }
        }
    }
}
