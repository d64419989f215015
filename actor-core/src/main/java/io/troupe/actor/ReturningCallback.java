package io.troupe.actor;

import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.Node;
import java.util.ArrayDeque;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/** A callback argument as the actor sees it: what the actor sends becomes entries of the caller's callback queue. */
final class ReturningCallback<T extends @Nullable Object> implements Callback<T> {
    private enum Kind {
        VALUE,
        FINISH,
        FAIL,
        /** The failure of a rejected call: delivered by the thread that rejects it if the reader's space is closed. */
        FAIL_EVEN_IF_CLOSED
    }

    private final Callback<T> reader;
    private final SpaceHome home;
    private final @Nullable Incarnation owner;
    private final @Nullable NewestResults<T> newest; // only if the reader does not receive every result
    private volatile boolean usedByOtherThreads;
    private volatile boolean ended;
    private volatile boolean readerGone;
    private boolean isEndDelivered; // on the reader's space

    private ReturningCallback(Callback<T> reader, SpaceHome home, @Nullable Incarnation owner) {
        this.reader = reader;
        this.home = home;
        this.owner = owner;
        this.newest = reader instanceof Stream<T> stream && stream.backlog().isBounded()
                ? new NewestResults<>(home, stream.backlog().most(), stream::noteSkipped)
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
        queue(new Result(Kind.VALUE, result));
    }

    /** Ends the callback, unless it has ended. */
    void endOnce(@Nullable Throwable error) {
        if (end()) {
            queue(new Result(error == null ? Kind.FINISH : Kind.FAIL, error));
        }
    }

    /** Reports an error of the reader that occurred on the sender's side. */
    void report(String what, Object whose, Throwable error) {
        home.reports().error(what, whose, error);
    }

    @Override
    public void accept(@Nullable T result, @Nullable Throwable error) {
        if (error != null) {
            fail(error);
        } else {
            checkNotEnded();
            send(Kind.VALUE, result);
        }
    }

    @Override
    public void finish() {
        endOrThrow();
        send(Kind.FINISH, null);
    }

    @Override
    public void fail(Throwable error) {
        endOrThrow();
        send(Kind.FAIL, error);
    }

    /** Ends the callback, unless it has ended, because no results will be sent. */
    void abandon(Throwable error) {
        if (end()) {
            send(Kind.FAIL_EVEN_IF_CLOSED, error);
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

    private void send(Kind kind, @Nullable Object content) {
        if (!isCancelled()) {
            queue(new Result(kind, content));
        }
    }

    private void queue(Result next) {
        CallObserver observer = home.settings.callObserver();
        if (observer != null && !next.isEnd()) {
            ObservedCalls.returned(observer, home, owner == null ? home.itself() : owner);
        }
        if (newest != null) {
            newest.queue(next);
        } else if (!home.isCurrent()) {
            if (!usedByOtherThreads) {
                usedByOtherThreads = true; // before the result is queued
            }
            home.enqueueAsRemote(next);
        } else if (usedByOtherThreads) {
            home.enqueueBehindArrivals(next); // it must not overtake theirs
        } else {
            home.enqueue(next);
        }
    }

    /**
     * The queued results of a reader that receives only the newest ones; only tickets for them are queued in the space.
     * A result that replaces another one is delivered for the ticket of an earlier one, so there are as many tickets as
     * results. A sender whose stack overflows may leave a result without a ticket: the next sender queues it. Any
     * thread.
     */
    private static final class NewestResults<T extends @Nullable Object> {
        private final SpaceHome home;
        private final int most;
        private final Runnable noteSkipped;
        private final ArrayDeque<ReturningCallback<T>.Result> results = new ArrayDeque<>(); // guarded by this
        private int tickets; // guarded by this; those in the space's queues

        NewestResults(SpaceHome home, int most, Runnable noteSkipped) {
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

    private final class Result extends Node implements Runnable {
        private final Kind kind;
        private final @Nullable Object content; // the value or the error

        Result(Kind kind, @Nullable Object content) {
            this.kind = kind;
            this.content = content;
        }

        boolean isEnd() {
            return kind != Kind.VALUE;
        }

        @Override
        protected @Nullable Node serve() {
            if (isEndDelivered) {
                return null; // its sender lost a race against the end
            }
            isEndDelivered = isEnd();
            if (home.hasEnded() && kind != Kind.FAIL_EVEN_IF_CLOSED) {
                readerGone = true; // the sender's thread is rejecting what is left in the queues
            } else if (owner == null) {
                home.runGuarded(this);
            } else if (!owner.run("a listener", this)) {
                readerGone = true; // the receiving actor has stopped
            }
            return null;
        }

        /** Calls the reader. */
        @Override
        @SuppressWarnings({"unchecked", "NullAway"}) // the content of a value is null only if T allows it
        public void run() {
            switch (kind) {
                case VALUE -> reader.accept((T) content, null);
                case FINISH -> reader.finish();
                case FAIL, FAIL_EVEN_IF_CLOSED -> reader.fail((Throwable) Objects.requireNonNull(content));
            }
        }
    }
}
