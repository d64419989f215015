package io.troupe.actor.promise;

import java.lang.invoke.MethodHandles;
import java.lang.invoke.VarHandle;
import java.time.Duration;
import java.util.Collection;
import java.util.List;
import java.util.Objects;
import java.util.concurrent.CancellationException;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.TimeoutException;
import java.util.function.BiConsumer;
import java.util.function.BiFunction;
import java.util.function.Consumer;
import java.util.function.Function;
import org.jspecify.annotations.Nullable;

/**
 * A value that arrives later, or the error that came instead.
 *
 * <p><b>Role.</b> What a request to an actor answers at once. Settled exactly once: fulfilled with a value or rejected with an error.
 * Made by calling an actor, by {@link Deferred}, or by {@link #of}.
 * <p><b>Threads.</b> Any thread. A listener runs on the thread of the actor space in which it was registered; registered elsewhere, on the
 * space the promise comes from, or, if there is none, on the thread that settles it (or registers, if that is later). In a space it
 * is an entry of the callback queue, never a call on the stack of whoever settles the promise.
 * <p><b>Order.</b> Listeners of one space run in the order of their registration, any number of them; only one that is registered at the very moment
 * at which another thread settles the promise may come before those registered earlier.
 * <p><b>Errors.</b> Errors travel unwrapped: what a request threw is what {@link #exceptionally} sees. A rejection nobody listens to is
 * reported to the space's error handler.
 * <p><b>Source.</b> Paper, sections 1 and 3.6; the names are those of {@link CompletableFuture}, and the paper's {@code then}.
 */
public abstract class Promise<T extends @Nullable Object> extends Node {
    /*
     * One field says everything, so that one compare-and-set decides between "settle" and "register":
     *   null           pending, nobody listens
     *   a Node         pending, with listeners: the newest, linked by Node.next to the older ones
     *   anything else  settled: the value itself, NULL, a Rejection, or a Boxed value (one that is itself a node)
     */
    private static final Object NULL = new Object();
    private static final VarHandle STATE;

    static {
        try {
            STATE = MethodHandles.lookup().findVarHandle(Promise.class, "state", Object.class);
        } catch (ReflectiveOperationException e) {
            throw new ExceptionInInitializerError(e);
        }
    }

    private static final Node REFUSED = new Relay(() -> {});

    private record Rejection(Throwable error) {}

    private record Boxed(Object value) {}

    private volatile @Nullable Object state;
    private volatile boolean listenedTo;

    protected Promise() {}

    /** Where listeners from outside every space run, and where a lost rejection is reported; null if nowhere. */
    protected abstract @Nullable Home home();

    /** Whether it was made by a thread outside its home, which may need a moment to register a listener. */
    protected boolean madeOutside() {
        return false;
    }

    // ---- made at once

    /** A promise that is already fulfilled. */
    public static <T extends @Nullable Object> Promise<T> of(T value) {
        var promise = new Deferred<T>();
        promise.resolve(value);
        return promise;
    }

    /** A promise of nothing, already fulfilled. */
    public static Promise<@Nullable Void> done() {
        return Promise.<@Nullable Void>of(null);
    }

    /** A promise that is already rejected. */
    public static <T extends @Nullable Object> Promise<T> failed(Throwable error) {
        var promise = new Deferred<T>();
        promise.reject(error);
        return promise;
    }

    /** Follows a {@link CompletionStage}; its {@code CompletionException}s are unwrapped. */
    public static <T extends @Nullable Object> Promise<T> from(CompletionStage<? extends T> stage) {
        var promise = new Deferred<T>();
        stage.whenComplete((value, error) -> {
            if (error == null) {
                promise.resolve(value);
            } else {
                promise.reject(Errors.unwrapCompletion(error));
            }
        });
        return promise;
    }

    // ---- looking at it

    public final boolean isDone() {
        return isSettled(state);
    }

    public final boolean isRejected() {
        return state instanceof Rejection;
    }

    public final boolean isCancelled() {
        return state instanceof Rejection(Throwable error) && error instanceof CancellationException;
    }

    /** The value if it is there, else null; a null value looks the same. */
    public final @Nullable T getNow() {
        Object now = state;
        return isSettled(now) && !(now instanceof Rejection) ? valueOf(now) : null;
    }

    /** The error if it is rejected, else null. */
    public final @Nullable Throwable error() {
        return state instanceof Rejection(Throwable error) ? error : null;
    }

    /**
     * Waits for the value, from outside.
     *
     * <p><b>Errors.</b> A rejection's own error is thrown as it is, a checked one too, never in an {@code ExecutionException}.
     *
     * @throws IllegalStateException on the thread of an actor space, which must never wait; use {@code then} or {@code thenCompose}
     * @throws TimeoutException if it is not settled in time
     */
    public final T get(Duration timeout) throws TimeoutException, InterruptedException {
        Waiter.await(this, timeout);
        Object now = Objects.requireNonNull(state);
        if (now instanceof Rejection(Throwable error)) {
            throw Errors.rethrow(error);
        }
        return valueOf(now);
    }

    // ---- what comes next

    /** The paper's {@code then(result -> ..)}: calls the listener with the value; the answer carries the same value on. */
    public final Promise<T> then(Consumer<? super T> listener) {
        Objects.requireNonNull(listener, "listener");
        return listen(new Stage.Transform<T, T>(this, value -> {
            listener.accept(value);
            return value;
        }));
    }

    /** The paper's {@code then((result, error) -> ..)}: calls the listener either way; the answer carries the same outcome on. */
    public final Promise<T> then(BiConsumer<? super @Nullable T, ? super @Nullable Throwable> listener) {
        return whenComplete(listener);
    }

    public final <R extends @Nullable Object> Promise<R> thenApply(Function<? super T, ? extends R> function) {
        return listen(new Stage.Transform<T, R>(this, function));
    }

    public final Promise<@Nullable Void> thenAccept(Consumer<? super T> consumer) {
        Objects.requireNonNull(consumer, "consumer");
        return listen(new Stage.Transform<T, @Nullable Void>(this, value -> {
            consumer.accept(value);
            return null;
        }));
    }

    public final Promise<@Nullable Void> thenRun(Runnable action) {
        Objects.requireNonNull(action, "action");
        return listen(new Stage.Transform<T, @Nullable Void>(this, value -> {
            action.run();
            return null;
        }));
    }

    public final <R extends @Nullable Object> Promise<R> thenCompose(
            Function<? super T, ? extends Promise<? extends R>> function) {
        return listen(new Stage.Compose<T, R>(this, function, null));
    }

    public final <U extends @Nullable Object, R extends @Nullable Object> Promise<R> thenCombine(
            Promise<? extends U> other, BiFunction<? super T, ? super U, ? extends R> function) {
        Objects.requireNonNull(function, "function");
        other.listenedTo = true;
        return thenCompose(mine -> other.<R>thenApply(theirs -> function.apply(mine, theirs)));
    }

    public final Promise<T> exceptionally(Function<Throwable, ? extends T> function) {
        Objects.requireNonNull(function, "function");
        return listen(new Stage.Handle<T, T>(this, (value, error) -> {
            return error == null ? Stage.present(value) : function.apply(error);
        }));
    }

    public final Promise<T> exceptionallyCompose(Function<Throwable, ? extends Promise<? extends T>> function) {
        return listen(new Stage.Compose<T, T>(this, Promise::of, function));
    }

    public final <R extends @Nullable Object> Promise<R> handle(
            BiFunction<? super @Nullable T, @Nullable Throwable, ? extends R> function) {
        return listen(new Stage.Handle<T, R>(this, function));
    }

    public final Promise<T> whenComplete(BiConsumer<? super @Nullable T, ? super @Nullable Throwable> listener) {
        return listen(new Stage.Observe<T>(this, listener));
    }

    /** Follows this promise, and is rejected with a {@link TimeoutException} when the time is over first. */
    public final Promise<T> orTimeout(Duration timeout) {
        Home place = Home.current() != null ? Home.current() : home();
        if (place == null) {
            throw new IllegalStateException(
                    "orTimeout needs a clock: call it in an actor space, or on a promise of one");
        }
        var limited = new Deferred<T>(place);
        var error = "no answer within " + timeout + " from " + this;
        Runnable withdraw = place.schedule(timeout.toNanos(), () -> limited.reject(new TimeoutException(error)));
        limited.follow(this);
        limited.register(new Relay(withdraw));
        return limited;
    }

    /**
     * Rejects this promise with a {@link CancellationException}, unless it is settled. A request that still waits in a mailbox is then
     * skipped; one that has begun goes on, and its answer is ignored.
     */
    public final boolean cancel() {
        return settle(new Rejection(new CancellationException(this + " was cancelled")));
    }

    /** A {@link CompletableFuture} that follows this promise; cancelling it does not reach back. */
    public final CompletableFuture<T> toCompletableFuture() {
        var future = new CompletableFuture<T>();
        register(new Relay(() -> {
            Object now = Objects.requireNonNull(state);
            if (now instanceof Rejection(Throwable error)) {
                future.completeExceptionally(error);
            } else {
                future.complete(valueOf(now));
            }
        }));
        return future;
    }

    // ---- several at once

    /** All values, in the order of the arguments; rejected with the first error. */
    public static <T extends @Nullable Object> Promise<List<T>> all(
            Collection<? extends Promise<? extends T>> promises) {
        return Gather.all(promises);
    }

    /** All outcomes, in the order of the arguments; never rejected. */
    public static <T extends @Nullable Object> Promise<List<Outcome<T>>> allSettled(
            Collection<? extends Promise<? extends T>> promises) {
        return Gather.allSettled(promises);
    }

    /** The first value; rejected when all are, with a {@link java.util.NoSuchElementException} that has their errors as suppressed ones. */
    public static <T extends @Nullable Object> Promise<T> any(Collection<? extends Promise<? extends T>> promises) {
        return Gather.any(promises);
    }

    /** The outcome of whichever is settled first. */
    public static <T extends @Nullable Object> Promise<T> race(Collection<? extends Promise<? extends T>> promises) {
        return Gather.race(promises);
    }

    // ---- for this room and for requests

    /** Fulfils this promise; false if it was settled before. */
    protected final boolean settleValue(T value) {
        return settle(
                value == null ? NULL : value instanceof Node || value instanceof Rejection ? new Boxed(value) : value);
    }

    /** Rejects this promise; false if it was settled before. */
    protected final boolean settleError(Throwable error) {
        return settle(new Rejection(Objects.requireNonNull(error, "error")));
    }

    /** Settles this promise as the other is, as soon as it is. */
    protected final void follow(Promise<? extends T> other) {
        if (other.isDone()) {
            other.listenedTo = true;
            settle(Objects.requireNonNull(other.state));
        } else {
            other.register(new Follower(this, other));
        }
    }

    /** Runs the node when this promise is settled: at once if it is. Stages go to their home's queue, relays run where they are. */
    final void register(Node listener) {
        listenedTo = true;
        while (true) {
            Object now = state;
            if (isSettled(now)) {
                listener.next = null;
                dispatch(listener);
                return;
            }
            listener.next = (Node) now;
            if (STATE.compareAndSet(this, now, listener)) {
                return;
            }
        }
    }

    /** Whether anybody will see how this promise ends. */
    public final boolean isListenedTo() {
        return listenedTo;
    }

    final Outcome<T> outcome() {
        Object now = Objects.requireNonNull(state);
        return now instanceof Rejection(Throwable error)
                ? new Outcome.Rejected<>(error)
                : new Outcome.Fulfilled<>(valueOf(now));
    }

    private <R extends @Nullable Object> Promise<R> listen(Stage<T, R> stage) {
        register(stage);
        return stage;
    }

    private boolean settle(Object outcome) {
        if (isDone()) {
            return false;
        }
        Node listeners = claim(outcome);
        if (listeners == REFUSED) {
            return false;
        }
        dispatchAll(listeners, outcome);
        return true;
    }

    /** Settles this promise and answers its listeners, newest first; {@link #REFUSED} if it was settled before. */
    private @Nullable Node claim(Object outcome) {
        while (true) {
            Object now = state;
            if (isSettled(now)) {
                return REFUSED;
            }
            if (STATE.compareAndSet(this, now, outcome)) {
                if (now == null) {
                    reportIfUnheard(outcome);
                }
                return (Node) now;
            }
        }
    }

    private void reportIfUnheard(Object outcome) {
        Home place = home();
        if (place != null
                && outcome instanceof Rejection(Throwable error)
                && !(error instanceof CancellationException)) {
            place.rejected(this, error);
        }
    }

    /**
     * Listeners run oldest first. Promises that only follow are settled in this loop, not each on the stack of the one before, so that a chain of them
     * may be of any length.
     */
    private static void dispatchAll(@Nullable Node newest, Object outcome) {
        Node waiting = reverse(newest, null);
        while (waiting != null) {
            Node listener = waiting;
            waiting = listener.next;
            listener.next = null;
            if (listener instanceof Follower follower) {
                Node more = follower.promise.claim(outcome);
                waiting = more == REFUSED ? waiting : reverse(more, waiting);
            } else {
                dispatch(listener);
            }
        }
    }

    /** Puts a list, newest first, in front of another, oldest first. */
    private static @Nullable Node reverse(@Nullable Node newest, @Nullable Node rest) {
        Node oldest = rest;
        for (Node node = newest; node != null; ) {
            Node before = node.next;
            node.next = oldest;
            oldest = node;
            node = before;
        }
        return oldest;
    }

    private static void dispatch(Node listener) {
        if (listener instanceof Stage<?, ?> stage) {
            stage.dispatch();
        } else {
            listener.run();
        }
    }

    /** A promise that is to end as another one does. */
    private static final class Follower extends Node {
        private final Promise<?> promise;
        private final Promise<?> leader;

        Follower(Promise<?> promise, Promise<?> leader) {
            this.promise = promise;
            this.leader = leader;
        }

        @Override
        protected void run() {
            promise.settle(Objects.requireNonNull(leader.state));
        }
    }

    private static boolean isSettled(@Nullable Object state) {
        return state != null && !(state instanceof Node);
    }

    @SuppressWarnings("unchecked") // only settleValue puts values in
    private T valueOf(Object settled) {
        if (settled == NULL) {
            return Stage.present(null);
        }
        return (T) (settled instanceof Boxed(Object value) ? value : settled);
    }
}
