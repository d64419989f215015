package io.troupe.actor;

import io.troupe.actor.internal.Message;
import io.troupe.actor.internal.loop.QueueEntry;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicInteger;
import org.jspecify.annotations.Nullable;

/**
 * A callback argument of a broadcast: the actors share its reader. It ends with the first error, or without one when
 * the last actor has finished.
 *
 * <p><b>Threads.</b> Any thread. Code of the reader runs on its space only.
 */
final class BroadcastCallback<T extends @Nullable Object> implements Callback<T> {
    private final ReturningCallback<T> reader;
    private final AtomicInteger open = new AtomicInteger(1); // the actors that have not finished, and the call itself
    private volatile boolean over;

    /**
     * Creates a callback for a call of the calling space and actor.
     *
     * @param ifOutside the space of the reader if the caller is outside every space
     */
    BroadcastCallback(Callback<T> reader, SpaceHome ifOutside) {
        this.reader = ReturningCallback.to(reader, ifOutside);
    }

    /** The callback that one of the actors receives. */
    Callback<T> share() {
        open.incrementAndGet();
        return new Share<>(this);
    }

    /** Notes that one actor has finished, or that all have received the call. */
    @Override
    public void finish() {
        if (open.decrementAndGet() == 0) {
            try {
                end(null);
            } catch (Throwable notQueued) { // the stack may be at its end: the caller may finish again
                open.incrementAndGet();
                throw notQueued;
            }
        }
    }

    /** Ends it for all actors, unless it has ended. */
    @Override
    public void fail(Throwable error) {
        end(error);
    }

    private void end(@Nullable Throwable error) {
        if (!reader.endUnderLock(error)) { // throws nothing if it has ended, unlike finish() and fail(..)
            reader.rejectLeftovers();
        }
        over = true;
    }

    @Override
    public void accept(@Nullable T result, @Nullable Throwable error) {
        if (error != null) {
            fail(error);
        } else if (!isCancelled()) {
            send(result);
        }
    }

    @SuppressWarnings("NullAway") // a result is null only if T allows it
    private void send(@Nullable T result) {
        reader.noteReturned();
        if (!reader.sendUnderLock(result)) {
            reader.rejectLeftovers();
        }
    }

    @Override
    public boolean isCancelled() {
        return over || reader.isCancelled();
    }

    /** Ends each callback of a broadcast among the arguments of a call that no actor begins. */
    static void abandon(QueueEntry call, Throwable error) {
        for (Object argument : Message.argumentsOf(call)) {
            if (argument instanceof Share<?> share) {
                share.whole.over = true;
                share.whole.reader.abandon(error);
            }
        }
    }

    static final class Share<T extends @Nullable Object> implements Callback<T> {
        private final BroadcastCallback<T> whole;
        private final AtomicBoolean ended = new AtomicBoolean();

        Share(BroadcastCallback<T> whole) {
            this.whole = whole;
        }

        @Override
        public void accept(@Nullable T result, @Nullable Throwable error) {
            if (error != null) {
                fail(error);
            } else if (ended.get()) {
                throw ReturningCallback.alreadyEnded();
            } else {
                whole.accept(result, null);
            }
        }

        @Override
        public void finish() {
            end(whole::finish);
        }

        @Override
        public void fail(Throwable error) {
            end(() -> whole.fail(error));
        }

        private void end(Runnable ending) {
            if (!ended.compareAndSet(false, true)) {
                throw ReturningCallback.alreadyEnded();
            }
            try {
                ending.run();
            } catch (Throwable notQueued) {
                ended.set(false);
                throw notQueued;
            }
        }

        @Override
        public boolean isCancelled() {
            return whole.isCancelled();
        }
    }
}
