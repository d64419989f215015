package io.troupe.actor;

import java.util.Objects;
import java.util.concurrent.CancellationException;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicLong;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * A parameter type through which an actor sends many results to its caller.
 *
 * <p><b>Role.</b> A parameter type of actor methods. The actor calls {@link #next}, and at the end {@link #finish} or
 * {@link #fail}. The caller passes a {@link Stream}: it is notified of the results and of the end, and can be
 * cancelled. A caller that needs the results only may pass a lambda, as in the paper: {@code robot.wander((colour,
 * error) -> ..)}; it receives a failure as an error, and is not notified of an end without one.
 *
 * {@snippet :
 * var stream = new Callback.Stream<Integer>(colour -> log.add("got " + colour), end -> log.add("end " + end));
 * camera.watch(stream); // stream.cancel() ends it
 *
 * camera.watch((colour, error) -> log.add("saw " + colour));
 * }
 *
 * <p><b>Threads.</b> The actor may call it from any thread. The caller's implementation runs on the caller's space, as
 * entries of its callback queue, on behalf of the calling actor. If the caller is outside every space, it runs on the
 * actor's space; once that is closed, only the failure of a rejected call is still delivered.
 *
 * <p><b>End.</b> The end of an actor does not end its callbacks: if it stops or restarts without {@link #finish} or
 * {@link #fail}, the callback stays open and no further results arrive. A caller can watch the actor with
 * {@link ActorSpace#whenStopped}. An actor that stores callbacks should fail them in {@code stopped()}.
 *
 * <p><b>Order.</b> Results arrive in the order in which they were sent; after the end, or after a cancellation, no more
 * results arrive.
 *
 * <p><b>Source.</b> Paper, section 3.5, Figure 17.
 */
@FunctionalInterface
public interface Callback<T extends @Nullable Object> {
    /** Receives one result or, with an error, the end. */
    void accept(@Nullable T result, @Nullable Throwable error);

    /** Sends one result. */
    default void next(T result) {
        accept(result, null);
    }

    /** Ends without an error; a plain lambda is not notified. */
    default void finish() {}

    /** Ends with an error. */
    default void fail(Throwable error) {
        accept(null, Objects.requireNonNull(error, "error"));
    }

    /**
     * True if results are no longer wanted, so that the actor may stop sending. An implementation runs only on the
     * space of the reader, as {@link #accept} does: on other threads an actor sees what it answered last.
     */
    default boolean isCancelled() {
        return false;
    }

    /**
     * The receiving side of a callback: it can be cancelled, by any thread, is notified of the end, and determines
     * which results are kept while it is slow.
     */
    final class Stream<T extends @Nullable Object> implements Callback<T> {
        private final int capacity;
        private final Consumer<? super T> onNext;
        private final Consumer<@Nullable Throwable> onEnd;
        private final boolean tellsOfCancellation;
        private final AtomicBoolean over = new AtomicBoolean();
        private final AtomicLong dropped = new AtomicLong();
        private volatile @Nullable ReturningCallback<?> receiver; // of the call or topic that got this stream last

        /**
         * Creates a stream that receives every result.
         *
         * @param onNext receives each result
         * @param onEnd receives the end, once: null for success, a {@link CancellationException} after {@link #cancel}
         */
        public Stream(Consumer<? super T> onNext, Consumer<@Nullable Throwable> onEnd) {
            this(Integer.MAX_VALUE, onNext, onEnd);
        }

        /**
         * Creates a stream that drops results while it is slow. The results that are kept arrive in the order in which
         * they were sent. A result for which there is no room takes the turn of the oldest one, so it may overtake
         * other callbacks that its sender queued in between. The end is always delivered, after the results.
         *
         * @param capacity the number of results that may be queued, 1 or more; one more drops the oldest
         * @param onNext receives each result that is kept
         * @param onEnd receives the end, once: null for success, a {@link CancellationException} after {@link #cancel}
         */
        public Stream(int capacity, Consumer<? super T> onNext, Consumer<@Nullable Throwable> onEnd) {
            this(capacity, onNext, onEnd, true);
        }

        Stream(
                int capacity,
                Consumer<? super T> onNext,
                Consumer<@Nullable Throwable> onEnd,
                boolean tellsOfCancellation) {
            this.tellsOfCancellation = tellsOfCancellation;
            if (capacity < 1) {
                throw new IllegalArgumentException("capacity is " + capacity + ", expected 1 or more");
            }
            this.capacity = capacity;
            this.onNext = Objects.requireNonNull(onNext, "onNext");
            this.onEnd = Objects.requireNonNull(onEnd, "onEnd");
        }

        /**
         * Cancels: no more results arrive, and the actor sees {@link #isCancelled}. The reader is notified of the end
         * on its space: at once if it cancels itself.
         */
        public void cancel() {
            if (over.compareAndSet(false, true) && tellsOfCancellation) {
                var error = new CancellationException("the reader has cancelled");
                ReturningCallback<?> knowsTheReader = receiver;
                try {
                    if (knowsTheReader == null) {
                        onEnd.accept(error);
                    } else {
                        knowsTheReader.runAtReader(() -> onEnd.accept(error));
                    }
                } catch (StackOverflowError notQueued) {
                    over.set(knowsTheReader == null); // the next call queues it
                    throw notQueued;
                }
            }
        }

        void setReceiver(ReturningCallback<?> next) {
            receiver = next;
        }

        /** The number of results that were dropped, because newer ones took their place in the queue; any thread. */
        public long dropped() {
            return dropped.get();
        }

        int capacity() {
            return capacity;
        }

        void noteDropped() {
            dropped.incrementAndGet();
        }

        @Override
        @SuppressWarnings("NullAway") // a result is null only if T allows it
        public void accept(@Nullable T result, @Nullable Throwable error) {
            if (error != null) {
                end(error);
            } else if (!over.get()) {
                onNext.accept(result);
            }
        }

        @Override
        public void finish() {
            end(null);
        }

        @Override
        public boolean isCancelled() {
            return over.get();
        }

        @Override
        public String toString() {
            return "stream" + (over.get() ? ", ended" : "") + (dropped() > 0 ? ", dropped " + dropped() : "");
        }

        private void end(@Nullable Throwable error) {
            if (over.compareAndSet(false, true)) {
                onEnd.accept(error);
            }
        }
    }
}
