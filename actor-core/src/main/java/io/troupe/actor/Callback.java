package io.troupe.actor;

import java.util.Objects;
import java.util.concurrent.CancellationException;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * An argument through which an actor sends many results back.
 *
 * <p><b>Role.</b> A parameter type of actor methods. The caller passes a lambda, as in the paper:
 * {@code robot.wander((colour, error) -> ..)}; the actor calls {@link #next}, and at the end {@link #finish} or
 * {@link #fail}. Who wants to stop listening, or to hear of the end, passes a {@link Stream}.
 *
 * {@snippet :
 * camera.watch((colour, error) -> log.add("saw " + colour));
 *
 * var stream = new Callback.Stream<Integer>(colour -> log.add("got " + colour), end -> log.add("end " + end));
 * camera.watch(stream); // stream.cancel() ends it
 * }
 *
 * <p><b>Threads.</b> The actor may call it from any thread. The caller's side runs on the caller's space, as entries of
 * its callback queue, on behalf of the calling actor; if the caller is no actor space, on the space of the actor, and
 * no more once that is closed, but for the failure of a call that is turned away.
 *
 * <p><b>End.</b> An actor need not end a callback, so its own end does not: one that stops or restarts without
 * {@link #finish} or {@link #fail} leaves the callback open, and nothing more arrives. Who must know watches the actor
 * with {@link ActorSpace#whenStopped}; an actor that keeps callbacks fails them in {@code stopped()}.
 *
 * <p><b>Order.</b> Results arrive in the order in which they were sent; after the end, or after a cancellation, nothing
 * arrives any more.
 *
 * <p><b>Source.</b> Paper, section 3.5, Figure 17.
 */
@FunctionalInterface
public interface Callback<T extends @Nullable Object> {
    /** One result, or, with an error, the end. */
    void accept(@Nullable T result, @Nullable Throwable error);

    /** Sends one result. */
    default void next(T result) {
        accept(result, null);
    }

    /** Ends with success; a plain lambda does not hear of it. */
    default void finish() {}

    /** Ends with an error. */
    default void fail(Throwable error) {
        accept(null, Objects.requireNonNull(error, "error"));
    }

    /** Whether nobody listens any more, so that the actor may stop sending. */
    default boolean isCancelled() {
        return false;
    }

    /** The reader's side of a callback that can be cancelled and that hears of the end. Any thread may cancel. */
    final class Stream<T extends @Nullable Object> implements Callback<T> {
        private final Consumer<? super T> onNext;
        private final Consumer<@Nullable Throwable> onEnd;
        private final AtomicBoolean over = new AtomicBoolean();

        /**
         * A stream.
         *
         * @param onNext hears each result
         * @param onEnd hears the end, once: null for success, a {@link CancellationException} after {@link #cancel}
         */
        public Stream(Consumer<? super T> onNext, Consumer<@Nullable Throwable> onEnd) {
            this.onNext = Objects.requireNonNull(onNext, "onNext");
            this.onEnd = Objects.requireNonNull(onEnd, "onEnd");
        }

        /** Stops listening: no result arrives any more, and the actor can see that. */
        public void cancel() {
            end(new CancellationException("the reader has cancelled"));
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

        private void end(@Nullable Throwable error) {
            if (over.compareAndSet(false, true)) {
                onEnd.accept(error);
            }
        }
    }
}
