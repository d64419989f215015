package io.troupe.actor;

import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.Node;
import java.util.ArrayDeque;
import org.jspecify.annotations.Nullable;

/** A callback argument as the actor sees it: what the actor sends becomes entries of the caller's callback queue. */
final class ReturningCallback<T extends @Nullable Object> implements Callback<T> {
    /** Whether more can follow, and whether it is delivered by the thread that rejects the remaining entries. */
    private enum Kind {
        VALUE,
        END,
        END_EVEN_IF_CLOSED
    }

    private final Callback<T> reader;
    private final SpaceHome home;
    private final @Nullable Incarnation owner;
    // for a reader that does not receive every result, and as soon as another thread sends
    private volatile @Nullable Waiting<T> waiting;
    private volatile boolean ended;
    private volatile boolean readerGone;

    private ReturningCallback(Callback<T> reader, SpaceHome home, @Nullable Incarnation owner) {
        this.reader = reader;
        this.home = home;
        this.owner = owner;
        this.waiting = reader instanceof Stream<T> stream && stream.backlog().isBounded()
                ? new Waiting<>(home, stream.backlog().most(), stream::noteSkipped)
                : null;
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
        queue(new Result(() -> reader.accept(result, null), Kind.VALUE));
    }

    /** Ends the callback, unless it has ended. */
    void endOnce(@Nullable Throwable error) {
        if (end()) {
            queue(new Result(error == null ? reader::finish : () -> reader.fail(error), Kind.END));
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
            send(() -> reader.accept(result, null), Kind.VALUE);
        }
    }

    @Override
    public void finish() {
        endOrThrow();
        send(reader::finish, Kind.END);
    }

    @Override
    public void fail(Throwable error) {
        endOrThrow();
        send(() -> reader.fail(error), Kind.END);
    }

    /** Ends the callback, unless it has ended, because no results will be sent. */
    void abandon(Throwable error) {
        if (end()) {
            send(() -> reader.fail(error), Kind.END_EVEN_IF_CLOSED);
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

    private void send(Runnable delivery, Kind kind) {
        if (!isCancelled()) {
            queue(new Result(delivery, kind));
        }
    }

    private void queue(Result next) {
        CallObserver observer = home.settings.callObserver();
        if (observer != null && !next.isEnd()) {
            ObservedCalls.returned(observer, home, owner == null ? home.itself() : owner);
        }
        Waiting<T> results = home.isCurrent() ? waiting : sharedQueue();
        if (results == null) {
            home.enqueue(next);
        } else {
            results.queue(next);
        }
    }

    private synchronized Waiting<T> sharedQueue() {
        Waiting<T> known = waiting;
        if (known == null) {
            known = new Waiting<>(home, Integer.MAX_VALUE, () -> {});
            waiting = known;
        }
        return known;
    }

    /**
     * The queued results, of which the newest ones are kept; only tickets for them are queued in the space. Results
     * sent by the space's own thread would otherwise overtake those that another thread put into the inbox before. A
     * result that replaces another one is delivered for the ticket of an earlier one, so there are as many tickets as
     * results. A sender whose stack overflows may leave a result without a ticket: the next sender queues it. Any
     * thread.
     */
    private static final class Waiting<T extends @Nullable Object> {
        private final SpaceHome home;
        private final int most;
        private final Runnable noteSkipped;
        private final ArrayDeque<ReturningCallback<T>.Result> results = new ArrayDeque<>(); // guarded by this
        private int tickets; // guarded by this; those in the space's queues

        Waiting(SpaceHome home, int most, Runnable noteSkipped) {
            this.home = home;
            this.most = most;
            this.noteSkipped = noteSkipped;
        }

        synchronized void queue(ReturningCallback<T>.Result next) {
            var last = results.peekLast();
            if (last != null && last.isEnd()) {
                return; // its sender lost a race against the end
            }
            if (!next.isEnd() && results.size() == most) {
                results.pollFirst();
                noteSkipped.run();
            }
            results.addLast(next);
            while (tickets < results.size()) {
                home.enqueue(new Ticket()); // served now if the space is closed
                tickets++;
            }
        }

        /** Takes the oldest result; null if a sender's stack overflowed after it had queued a ticket. */
        private synchronized ReturningCallback<T>.@Nullable Result next() {
            tickets--;
            return results.pollFirst();
        }

        private final class Ticket extends Node {
            @Override
            protected @Nullable Node serve() {
                var result = next();
                return result == null ? null : result.serve();
            }
        }
    }

    private final class Result extends Node {
        private final Runnable delivery;
        private final Kind kind;

        Result(Runnable delivery, Kind kind) {
            this.delivery = delivery;
            this.kind = kind;
        }

        boolean isEnd() {
            return kind != Kind.VALUE;
        }

        @Override
        protected @Nullable Node serve() {
            if (home.hasEnded() && kind != Kind.END_EVEN_IF_CLOSED) {
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
