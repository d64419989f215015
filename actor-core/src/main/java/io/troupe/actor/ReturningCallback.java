package io.troupe.actor;

import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.Node;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import org.jspecify.annotations.Nullable;

/** A callback argument as the actor sees it: what the actor sends becomes entries of the caller's callback queue. */
final class ReturningCallback<T extends @Nullable Object> implements Callback<T> {
    private final Callback<T> reader;
    private final SpaceHome home;
    private final @Nullable Incarnation owner;
    private volatile boolean ended;
    private volatile boolean readerGone;
    private volatile @Nullable Queue<Delivery> pending;

    private ReturningCallback(Callback<T> reader, SpaceHome home, @Nullable Incarnation owner) {
        this.reader = reader;
        this.home = home;
        this.owner = owner;
    }

    /** Wraps a callback argument; one that was wrapped before keeps its first reader. */
    static <T extends @Nullable Object> @Nullable Callback<T> wrap(@Nullable Callback<T> callback, SpaceHome callee) {
        return callback == null ? null : to(callback, callee);
    }

    /** Wraps a callback for the calling space and actor; for a caller outside every space, for the given space. */
    static <T extends @Nullable Object> ReturningCallback<T> to(Callback<T> reader, SpaceHome ifOutside) {
        if (reader instanceof ReturningCallback<T> before) {
            return before;
        }
        SpaceHome caller = Home.current() instanceof SpaceHome here ? here : null;
        return caller == null
                ? new ReturningCallback<>(reader, ifOutside, null)
                : new ReturningCallback<>(reader, caller, caller.owner() instanceof Incarnation life ? life : null);
    }

    /** True if no more results can arrive. */
    boolean isOver() {
        return ended || isCancelled();
    }

    /** Sends one result to a reader that was checked before. */
    void sendTo(T result) {
        queue(() -> reader.accept(result, null), false);
    }

    /** Ends the callback, unless it has ended. */
    void endOnce(@Nullable Throwable error) {
        if (end()) {
            queue(error == null ? reader::finish : () -> reader.fail(error), false);
        }
    }

    /** Reports an error of the reader that occurred on the sender's side. */
    void report(String what, Object whose, Throwable error) {
        home.reports().error(what, whose, error, null);
    }

    @Override
    public void accept(@Nullable T result, @Nullable Throwable error) {
        if (error != null) {
            fail(error);
        } else {
            checkNotEnded();
            send(() -> reader.accept(result, null));
        }
    }

    @Override
    public void finish() {
        endOrThrow();
        send(reader::finish);
    }

    @Override
    public void fail(Throwable error) {
        endOrThrow();
        send(() -> reader.fail(error));
    }

    /** Ends the callback, unless it has ended, because no results will be sent. */
    void abandon(Throwable error) {
        if (end()) {
            send(() -> reader.fail(error), true);
        }
    }

    @Override
    public boolean isCancelled() {
        return readerGone || owner != null && owner.isOver() || reader.isCancelled();
    }

    private void checkNotEnded() {
        if (ended) {
            throw alreadyEnded();
        }
    }

    private void endOrThrow() {
        if (!end()) {
            throw alreadyEnded();
        }
    }

    /** Marks the callback as ended; false if it was ended before. */
    private synchronized boolean end() {
        boolean first = !ended;
        ended = true;
        return first;
    }

    private static IllegalStateException alreadyEnded() {
        return new IllegalStateException("this callback has been finished or failed before: nothing can follow");
    }

    private void send(Runnable delivery) {
        send(delivery, false);
    }

    private void send(Runnable delivery, boolean evenIfClosed) {
        if (!isCancelled()) {
            queue(delivery, evenIfClosed);
        }
    }

    private void queue(Runnable delivery, boolean evenIfClosed) {
        var next = new Delivery(delivery, evenIfClosed);
        Queue<Delivery> waiting = home.isCurrent() ? pending : pendingQueue();
        if (waiting == null) {
            home.enqueue(next);
        } else {
            waiting.add(next);
            home.enqueue(new Ticket(waiting));
        }
    }

    private synchronized Queue<Delivery> pendingQueue() {
        if (pending == null) {
            pending = new ConcurrentLinkedQueue<>();
        }
        return pending;
    }

    /**
     * The turn of the next queued result. Results sent by the space's own thread would overtake those that another
     * thread put into the inbox before. So as soon as another thread sends, results wait in a separate queue, and only
     * tickets are queued in the space.
     */
    private static final class Ticket extends Node {
        private final Queue<? extends ReturningCallback<?>.Delivery> waiting;

        Ticket(Queue<? extends ReturningCallback<?>.Delivery> waiting) {
            this.waiting = waiting;
        }

        @Override
        protected @Nullable Node serve() {
            return waiting.remove().serve();
        }
    }

    private final class Delivery extends Node {
        private final Runnable delivery;
        private final boolean evenIfClosed;

        /**
         * Creates a delivery.
         *
         * @param evenIfClosed true if it is delivered even when the space is closed, on the thread that rejects the
         *     remaining entries
         */
        Delivery(Runnable delivery, boolean evenIfClosed) {
            this.delivery = delivery;
            this.evenIfClosed = evenIfClosed;
        }

        @Override
        protected @Nullable Node serve() {
            if (home.hasEnded() && !evenIfClosed) {
                readerGone = true; // the sender's thread is rejecting what is left in the queues
            } else if (owner == null) {
                home.runGuarded(delivery);
            } else if (!owner.run("a listener", delivery)) {
                readerGone = true; // the receiving actor has stopped
            }
            return null;
        }
    }
}
