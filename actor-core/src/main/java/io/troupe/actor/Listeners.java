package io.troupe.actor;

import io.troupe.actor.internal.loop.DetachedEntries;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.QueueEntries;
import io.troupe.actor.internal.loop.QueueEntry;
import io.troupe.actor.internal.loop.TurnOwner;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.function.BooleanSupplier;
import org.jspecify.annotations.Nullable;

/**
 * The listeners of a promise, other than a {@link Stage}. Also runs listeners without a home, on the thread that
 * settles their promise: one after the other, never nested, so a chain of them may have any length.
 */
final class Listeners {
    /** The listeners that wait for their turn on a thread that keeps none; present while it runs one. */
    private static final ThreadLocal<@Nullable DetachedEntries> DETACHED = new ThreadLocal<>();

    private Listeners() {}

    /** Runs a listener without a home, after those that the calling thread is already running. */
    static void runDetached(QueueEntry listener) {
        DetachedEntries nodes = DetachedEntries.kept();
        if (nodes == null) {
            nodes = DETACHED.get();
        }
        if (nodes != null) {
            nodes.run(listener);
            return;
        }
        nodes = new DetachedEntries();
        DETACHED.set(nodes);
        try {
            nodes.run(listener);
        } finally {
            DETACHED.remove();
        }
    }

    /** An internal listener that only passes an outcome on, so it may run on any thread that settles the promise. */
    static final class Inline extends QueueEntry {
        private final Runnable action;
        private final BooleanSupplier isOver;

        /**
         * Creates a listener for another promise.
         *
         * @param reader the promise that needs the outcome; once it is settled, this listener is no longer needed
         */
        Inline(Runnable action, Promise<?> reader) {
            this(action, reader::isDone);
        }

        /**
         * Creates a listener.
         *
         * @param isOver true once this listener is no longer needed; called by any thread
         */
        Inline(Runnable action, BooleanSupplier isOver) {
            this.action = action;
            this.isOver = isOver;
        }

        @Override
        protected @Nullable QueueEntry serve() {
            action.run();
            return null;
        }

        @Override
        protected boolean isIdle() {
            return isOver.getAsBoolean();
        }
    }

    /** A listener that settles one promise with the outcome of another; it is never run. */
    static class Follower extends QueueEntry {
        final Settleable<?> promise;

        Follower(Settleable<?> promise) {
            this.promise = promise;
        }

        /** Called when the source is settled, before the following promise is. */
        void beforeSettling() {}

        @Override
        protected final boolean isIdle() {
            return promise.isDone();
        }
    }

    /** The listener of a thread outside every space that waits for a promise. */
    static final class Waiter extends QueueEntry {
        private final CountDownLatch settled = new CountDownLatch(1);
        private volatile boolean gone;

        private Waiter() {}

        static void await(Promise<?> promise, Duration timeout) throws TimeoutException, InterruptedException {
            if (Home.current() != null) {
                throw new IllegalStateException(
                        "get() would stop the whole space, and with it the code that could settle "
                                + promise.name()
                                + ": register what comes next with then(..), return thenCompose(..), or write await() in the body of sequential(..)");
            }
            if (DETACHED.get() != null) {
                throw new IllegalStateException(
                        "get() in a listener would keep the other listeners of this thread from running, and with them the code that could settle "
                                + promise.name() + ": register what comes next with then(..)");
            }
            if (promise.isDone()) {
                promise.markHandled();
                return;
            }
            var waiter = new Waiter();
            promise.register(waiter);
            try {
                if (!waiter.settled.await(Home.nanosOf(timeout), TimeUnit.NANOSECONDS)) {
                    throw new TimeoutException("no answer within " + timeout + " from " + promise.name());
                }
            } finally {
                waiter.gone = true;
            }
        }

        @Override
        protected @Nullable QueueEntry serve() {
            settled.countDown();
            return null;
        }

        @Override
        protected boolean isIdle() {
            return gone;
        }

        @Override
        protected boolean hasTimedOut() {
            return gone;
        }
    }

    /**
     * The listeners of a pending promise that has more than a few. When their number has doubled, listeners that are no
     * longer needed are removed. So a long-lived promise keeps at most about twice as many as are needed.
     *
     * <p><b>Threads.</b> Guarded by its own monitor. <b>Cost.</b> Amortized constant time per listener.
     */
    static final class Many extends QueueEntry {
        private static final int FEW = 8;

        private final List<QueueEntry> nodes = new ArrayList<>(2 * FEW); // oldest first
        private int sweepAt = 2 * FEW;
        private boolean closed;

        /**
         * Takes over a linked list for which {@link #isMany} holds, and adds one listener. Does not change the links,
         * because another thread may be settling the list.
         */
        Many(@Nullable QueueEntry newest, QueueEntry more) {
            QueueEntry node = newest;
            for (int count = 0; count < FEW && node != null; count++) {
                nodes.addFirst(node);
                node = QueueEntries.next(node);
            }
            nodes.add(more);
        }

        /** True if a linked list is long enough to be replaced by this class. */
        static boolean isMany(@Nullable QueueEntry newest) {
            QueueEntry node = newest;
            int count = 0;
            while (node != null && count < FEW) {
                node = QueueEntries.next(node);
                count++;
            }
            return count == FEW;
        }

        /**
         * True if no listener of a short linked list (not {@link #isMany}) needs the outcome. The result is valid only
         * if the list was not settled meanwhile.
         */
        static boolean areGivenUp(QueueEntry newest) {
            QueueEntry node = newest;
            // bounded: the links of a list that is being settled may change
            for (int count = 0; count < FEW && node != null; count++) {
                if (!isGivenUp(node)) {
                    return false;
                }
                node = QueueEntries.next(node);
            }
            return true;
        }

        /** A thread whose wait timed out may wait again, so it does not count as gone. */
        private static boolean isGivenUp(QueueEntry listener) {
            boolean isGone = QueueEntries.isIdle(listener)
                    || listener instanceof Follower follower
                            && follower.promise.mayBeGivenUp()
                            && follower.promise.isGivenUp();
            return isGone && !(listener instanceof Waiter);
        }

        /** True if no listener needs the outcome, or if the promise has been settled. */
        synchronized boolean areGivenUp() {
            return closed || nodes.stream().allMatch(Many::isGivenUp);
        }

        /** Adds a listener; false if the promise has been settled. */
        synchronized boolean add(QueueEntry listener) {
            if (closed) {
                return false;
            }
            while (!nodes.isEmpty() && QueueEntries.isIdle(nodes.getLast())) {
                nodes.removeLast();
            }
            if (nodes.size() >= sweepAt) {
                nodes.removeIf(QueueEntries::isIdle);
                sweepAt = Math.max(2 * FEW, 2 * nodes.size());
            }
            nodes.add(listener);
            return true;
        }

        /** Links the listeners; returns the newest. */
        synchronized QueueEntry link() {
            QueueEntry newest = nodes.getFirst();
            QueueEntries.link(newest, null);
            for (QueueEntry node : nodes.subList(1, nodes.size())) {
                QueueEntries.link(node, newest);
                newest = node;
            }
            return newest;
        }

        synchronized boolean isClosed() {
            return closed;
        }

        /** Rejects further listeners. */
        synchronized void close() {
            closed = true;
        }
    }

    /**
     * The requests that an owner has begun and not answered: each follows the promise that its method returned. The
     * owner rejects them if it ends first.
     *
     * <p><b>Threads.</b> Guarded by its own monitor, because a promise may be settled on any thread.
     */
    static final class OpenRequests implements TurnOwner.OpenRequests {
        private static final int FEW = 8;

        private @Nullable OpenRequest oldest;
        private @Nullable OpenRequest newest;
        private int size;
        private int sweepAt = FEW;

        /** Settles a request with the outcome of the other promise; the request is open until then. */
        static void follow(Settleable<?> request, Promise<?> other, TurnOwner owner) {
            var open = (OpenRequests) owner.openRequests(OpenRequests::new);
            var link = new OpenRequest(request, open);
            open.add(link);
            other.register(link);
        }

        /** Adds a request. Cancelled requests are removed whenever the number has doubled. */
        private synchronized void add(OpenRequest link) {
            if (size >= sweepAt) {
                OpenRequest next;
                for (OpenRequest each = oldest; each != null; each = next) {
                    next = each.after;
                    if (each.isIdle()) {
                        unlink(each);
                    }
                }
                sweepAt = Math.max(FEW, 2 * size);
            }
            link.listed = true;
            link.before = newest;
            if (newest == null) {
                oldest = link;
            } else {
                newest.after = link;
            }
            newest = link;
            size++;
        }

        private synchronized void remove(OpenRequest link) {
            if (link.listed) {
                unlink(link);
            }
        }

        private void unlink(OpenRequest link) {
            OpenRequest before = link.before;
            OpenRequest after = link.after;
            if (before == null) {
                oldest = after;
            } else {
                before.after = after;
            }
            if (after == null) {
                newest = before;
            } else {
                after.before = before;
            }
            link.before = null;
            link.after = null;
            link.listed = false;
            size--;
        }

        @Override
        public synchronized @Nullable QueueEntry takeOldest() {
            OpenRequest first = oldest;
            if (first == null) {
                return null;
            }
            unlink(first);
            return first.promise;
        }

        private static final class OpenRequest extends Follower {
            private final OpenRequests list;
            boolean listed;

            @Nullable
            OpenRequest before;

            @Nullable
            OpenRequest after;

            OpenRequest(Settleable<?> request, OpenRequests list) {
                super(request);
                this.list = list;
            }

            @Override
            void beforeSettling() {
                list.remove(this);
            }
        }
    }
}
