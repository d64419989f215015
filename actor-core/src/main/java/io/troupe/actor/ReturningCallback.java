package io.troupe.actor;

import io.troupe.actor.internal.BoundedQueue;
import io.troupe.actor.internal.CancellationFlag;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.QueueEntry;
import io.troupe.actor.internal.loop.TurnOwner;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * A callback argument as the actor sees it: what the actor sends becomes entries of the caller's callback queue.
 *
 * <p><b>Threads.</b> Any thread. Code of the reader runs only on its space, and never under a lock.
 */
final class ReturningCallback<T extends @Nullable Object> implements Callback<T> {
    private enum Kind {
        VALUE,
        FINISH,
        FAIL,
        /** The failure of a rejected call: delivered by the thread that rejects it if the reader's space is closed. */
        FAIL_EVEN_IF_CLOSED
    }

    /** Whether a class of readers implements {@code isCancelled()}; most are lambdas, which do not. */
    private static final ClassValue<Boolean> OWN_IS_CANCELLED = new ClassValue<>() {
        @Override
        protected Boolean computeValue(Class<?> type) {
            try {
                return type.getMethod("isCancelled").getDeclaringClass() != Callback.class;
            } catch (NoSuchMethodException | LinkageError | SecurityException unknown) {
                return true;
            }
        }
    };

    private final Callback<T> reader;
    private final SpaceHome home;
    private final TurnOwner owner; // an incarnation, or the home itself
    private final @Nullable CancellationFlag flag; // of a reader of this library
    private final boolean mayCancel; // the reader, by an isCancelled() of its class
    private final @Nullable NewestResults<T> newest; // only if the reader does not receive every result
    private volatile boolean usedByOtherThreads;
    private volatile boolean ended;
    private volatile boolean readerGone;
    private volatile boolean asked; // the reader, on its space, whether it has cancelled
    private boolean isEndDelivered; // on the reader's space

    private ReturningCallback(Callback<T> reader, SpaceHome home, TurnOwner owner) {
        this.reader = reader;
        this.home = home;
        this.owner = owner;
        Stream<T> stream = reader instanceof Stream<T> receiving ? receiving : null;
        this.flag = stream != null ? stream::isCancelled : reader instanceof CancellationFlag own ? own : null;
        this.mayCancel = flag == null && OWN_IS_CANCELLED.get(reader.getClass());
        this.newest = stream != null && stream.capacity() != Integer.MAX_VALUE
                ? new NewestResults<>(home, stream.capacity(), stream::noteDropped)
                : null;
        if (stream != null) {
            stream.setReceiver(this);
        }
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
                ? new ReturningCallback<>(reader, ifOutside, ifOutside.itself())
                : new ReturningCallback<>(
                        reader, caller, caller.owner() instanceof Incarnation life ? life : caller.itself());
    }

    /** True if no more results can arrive, as far as is known: this runs no code of the reader. */
    boolean isOver() {
        return ended || isKnownAsGone();
    }

    /**
     * Sends one result to a reader that was checked before, for a caller that holds a lock.
     *
     * @return false if the caller has to call {@link #rejectLeftovers} when it has released the lock
     */
    boolean sendUnderLock(T result) {
        return queue(new Result(Kind.VALUE, result));
    }

    /** Ends the callback, unless it has ended; for a caller that holds a lock, like {@link #sendUnderLock}. */
    boolean endUnderLock(@Nullable Throwable error) {
        return endBy(error == null ? Kind.FINISH : Kind.FAIL, error) != Ending.CLOSED;
    }

    /** Rejects what was sent to a closed space. */
    void rejectLeftovers() {
        home.rejectLeftovers();
    }

    boolean isObserved() {
        return home.settings.callObserver() != null;
    }

    /** Notifies the observer of calls, if there is one, of a result; not under a lock. */
    void noteReturned() {
        CallObserver observer = home.settings.callObserver();
        if (observer != null) {
            ObservedCalls.returned(observer, home, owner);
        }
    }

    /** Runs code of the reader on its space and on its behalf: at once if it is the caller. */
    void runAtReader(Runnable code) {
        if (home.isCurrent() && (owner == home.itself() || home.owner() == owner)) {
            code.run();
        } else if (!home.enqueueUnderLock(new AtReader(code))) {
            rejectLeftovers();
        }
    }

    @Override
    public void accept(@Nullable T result, @Nullable Throwable error) {
        if (error != null) {
            fail(error);
        } else {
            checkNotEnded();
            if (!isKnownAsGone()) {
                noteReturned();
                if (!queue(new Result(Kind.VALUE, result))) {
                    rejectLeftovers();
                }
            }
        }
    }

    @Override
    public void finish() {
        endOrThrow(Kind.FINISH, null);
    }

    @Override
    public void fail(Throwable error) {
        endOrThrow(Kind.FAIL, error);
    }

    /** Ends the callback, unless it has ended, because no results will be sent. */
    void abandon(Throwable error) {
        if (endBy(Kind.FAIL_EVEN_IF_CLOSED, error) == Ending.CLOSED) {
            rejectLeftovers();
        }
    }

    private void endOrThrow(Kind kind, @Nullable Throwable error) {
        Ending ending = endBy(kind, error);
        if (ending == Ending.NOT_THE_FIRST) {
            throw alreadyEnded();
        }
        if (ending == Ending.CLOSED) {
            rejectLeftovers();
        }
    }

    private enum Ending {
        DONE,
        /** The space is closed, so {@link #rejectLeftovers} has to be called, not under a lock. */
        CLOSED,
        NOT_THE_FIRST
    }

    /** Ends the callback, unless it has ended. If this throws, it has not. */
    private Ending endBy(Kind kind, @Nullable Throwable error) {
        synchronized (this) {
            if (ended) {
                return Ending.NOT_THE_FIRST;
            }
            ended = true;
        }
        try {
            return isKnownAsGone() || queue(new Result(kind, error)) ? Ending.DONE : Ending.CLOSED;
        } catch (Throwable notQueued) {
            ended = false; // no call: the stack may be at its end
            throw notQueued;
        }
    }

    @Override
    public boolean isCancelled() {
        if (isKnownAsGone()) {
            return true;
        }
        if (mayCancel) {
            askReader();
        }
        return readerGone;
    }

    private boolean isKnownAsGone() {
        return readerGone || owner.isOver() || flag != null && flag.isCancelled();
    }

    /** Makes the reader note on its space whether it has cancelled. */
    private void askReader() {
        if (!asked) {
            asked = true;
            try {
                runAtReader(() -> {
                    asked = false;
                    if (!readerGone) {
                        noteIfCancelled();
                    }
                });
            } catch (Throwable notQueued) {
                asked = false;
                throw notQueued;
            }
        }
    }

    private void noteIfCancelled() {
        try {
            readerGone |= reader.isCancelled();
        } catch (Throwable broken) {
            readerGone = true;
            throw broken;
        }
    }

    private void checkNotEnded() {
        if (ended) {
            throw alreadyEnded();
        }
    }

    static IllegalStateException alreadyEnded() {
        return new IllegalStateException("this callback has been finished or failed before: nothing can follow");
    }

    /** Returns false if the space is closed, so that {@link #rejectLeftovers} has to be called, not under a lock. */
    private boolean queue(Result next) {
        if (newest != null) {
            return newest.queue(next);
        } else if (!home.isCurrent()) {
            if (!usedByOtherThreads) {
                usedByOtherThreads = true; // before the result is queued
            }
            return home.enqueueUnderLock(next);
        } else if (usedByOtherThreads) {
            home.enqueueBehindArrivals(next); // it must not overtake theirs
        } else {
            home.enqueue(next);
        }
        return true;
    }

    /**
     * The queued results of a reader that receives only the newest ones; only tickets for them are queued in the space.
     * A result that replaces another one is delivered for the ticket of an earlier one, so there are as many tickets as
     * results. A sender whose stack overflows may leave a result without a ticket: the next sender queues it. Any
     * thread.
     */
    private static final class NewestResults<T extends @Nullable Object> {
        private final SpaceHome home;
        private final Runnable noteDropped;
        private final BoundedQueue<ReturningCallback<T>.Result> results; // guarded by this
        private int tickets; // guarded by this; those in the space's queues

        NewestResults(SpaceHome home, int capacity, Runnable noteDropped) {
            this.home = home;
            this.results = BoundedQueue.droppingOldest(capacity);
            this.noteDropped = noteDropped;
        }

        /** Returns false if the space is closed. */
        synchronized boolean queue(ReturningCallback<T>.Result next) {
            var last = results.peekLast();
            if (last == null || !last.isEnd()) { // else its sender lost a race against the end
                if (next.isEnd()) {
                    results.offerEnd(next);
                } else if (results.offer(next) != null) {
                    noteDropped.run();
                }
            }
            boolean isOpen = true;
            while (tickets < results.size()) {
                isOpen &= home.enqueueUnderLock(new Ticket());
                tickets++;
            }
            return isOpen;
        }

        /** Takes the oldest result; null if a sender's stack overflowed after it had queued a ticket. */
        private synchronized ReturningCallback<T>.@Nullable Result next() {
            tickets--;
            return results.poll();
        }

        private final class Ticket extends QueueEntry {
            @Override
            protected @Nullable QueueEntry serve() {
                var result = next();
                return result == null ? null : result.serve();
            }
        }
    }

    /** Code of the reader, which runs on its space and on its behalf. */
    private final class AtReader extends QueueEntry {
        private final Runnable code;

        AtReader(Runnable code) {
            this.code = code;
        }

        @Override
        protected @Nullable QueueEntry serve() {
            if (!owner.run("a listener", code)) {
                readerGone = true;
            }
            return null;
        }
    }

    private final class Result extends QueueEntry implements Runnable {
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
        protected @Nullable QueueEntry serve() {
            if (isEndDelivered) {
                return null; // its sender lost a race against the end
            }
            isEndDelivered = isEnd();
            if (home.hasEnded() && kind != Kind.FAIL_EVEN_IF_CLOSED) {
                readerGone = true; // the sender's thread is rejecting what is left in the queues
            } else if (!owner.run("a listener", this)) {
                readerGone = true; // the receiving actor has stopped
            }
            return null;
        }

        /** Calls the reader. */
        @Override
        @SuppressWarnings({"unchecked", "NullAway"}) // the content of a value is null only if T allows it
        public void run() {
            if (mayCancel) {
                if (!readerGone) {
                    noteIfCancelled();
                }
                if (readerGone) {
                    return;
                }
            }
            switch (kind) {
                case VALUE -> reader.accept((T) content, null);
                case FINISH -> reader.finish();
                case FAIL, FAIL_EVEN_IF_CLOSED -> reader.fail((Throwable) Objects.requireNonNull(content));
            }
        }
    }
}
