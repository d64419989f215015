package io.troupe.actor.promise;

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
 * <p><b>Role.</b> What a request to an actor answers at once. Settled exactly once: fulfilled with a value or rejected
 * with an error. Made by calling an actor, by {@link Deferred}, or by {@link #of}.
 *
 * {@snippet :
 * Promise<String> receipt = shop.price("lamp")
 *         .thenCompose(price -> shop.buy("lamp", price))
 *         .orTimeout(Duration.ofSeconds(2))
 *         .exceptionally(error -> "not bought: " + error.getMessage());
 * }
 *
 * <p><b>Threads.</b> Any thread. A listener runs on the thread of the actor space in which it was registered;
 * registered elsewhere, on the space the promise comes from, or, if there is none, on the thread that settles it (or
 * registers, if that is later). In a space it is an entry of the callback queue, never a call on the stack of whoever
 * settles the promise.
 *
 * <p><b>Order.</b> Listeners of one space run in the order of their registration, any number of them.
 *
 * <p><b>Cost.</b> A settled promise keeps its outcome, and the promise of a request also the arguments of the call.
 *
 * <p><b>Errors.</b> Errors travel unwrapped: what a request threw is what {@link #exceptionally} sees. A rejection
 * nobody listens to is reported to the space's error handler.
 *
 * <p><b>Source.</b> Paper, sections 1 and 3.6; the names are those of {@link CompletableFuture}, and the paper's
 * {@code then}.
 */
public abstract class Promise<T extends @Nullable Object> extends Settleable<T> {
    /** @hidden */
    protected Promise() {}

    Promise(Object outcome) {
        super(outcome);
    }

    // ---- made at once

    /**
     * A promise that is already fulfilled; it belongs to no space, so a listener registered outside every space runs at
     * once.
     */
    public static <T extends @Nullable Object> Promise<T> of(T value) {
        return new Settled<>(value);
    }

    /** A promise of nothing, already fulfilled. */
    public static Promise<@Nullable Void> done() {
        return Settled.DONE;
    }

    /** A promise that is already rejected. */
    public static <T extends @Nullable Object> Promise<T> failed(Throwable error) {
        Objects.requireNonNull(error, "error");
        var promise = new Deferred<T>();
        promise.reject(error);
        return promise;
    }

    /** Follows a {@link CompletionStage}; its {@code CompletionException}s are unwrapped. */
    public static <T extends @Nullable Object> Promise<T> from(CompletionStage<? extends T> stage) {
        Objects.requireNonNull(stage, "stage");
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

    public final boolean isRejected() {
        return outcomeNow() instanceof Rejection;
    }

    public final boolean isCancelled() {
        return error() instanceof CancellationException;
    }

    /** The value if it is there, else null; a null value looks the same. */
    public final @Nullable T getNow() {
        Object outcome = outcomeNow();
        return outcome == null || outcome instanceof Rejection ? null : valueOf(outcome);
    }

    /** The error if it is rejected, else null. */
    public final @Nullable Throwable error() {
        return outcomeNow() instanceof Rejection rejection ? rejection.error() : null;
    }

    /**
     * Waits for the value, from outside.
     *
     * <p><b>Errors.</b> A rejection's own error is thrown as it is, a checked one too, never in an
     * {@code ExecutionException}: to catch an {@code IOException}, say, catch {@code Exception} and look. Its stack is
     * that of the thread where it was thrown, and has no frame of the caller.
     *
     * @throws IllegalStateException on the thread of an actor space, which must never wait; use {@code then} or
     *     {@code thenCompose}
     * @throws TimeoutException if it is not settled in time
     */
    public final T get(Duration timeout) throws TimeoutException, InterruptedException {
        Waiter.await(this, Objects.requireNonNull(timeout, "timeout"));
        return valueOrThrow();
    }

    /**
     * Waits for the value in the body of {@code ActorSpace.sequential(..)}; the space serves others meanwhile.
     *
     * <p><b>Errors.</b> A rejection's own error is thrown as it is, a checked one too.
     *
     * @throws IllegalStateException anywhere else; the text says what to write instead
     * @throws CancellationException if the actor on whose behalf the body runs has stopped meanwhile, or its space has
     *     been closed
     */
    public final T await() {
        Home here = Home.current();
        if (here == null) {
            throw new IllegalStateException(
                    "await() belongs in the body of ActorSpace.sequential(..); a thread outside the space waits with get(Duration)");
        }
        if (isDone()) {
            hear();
        } else {
            here.await(this);
        }
        return valueOrThrow();
    }

    private T valueOrThrow() {
        Object outcome = Objects.requireNonNull(outcomeNow());
        if (outcome instanceof Rejection rejection) {
            throw Errors.rethrow(rejection.error());
        }
        return valueOf(outcome);
    }

    // ---- what comes next

    /**
     * The paper's {@code then(result -> ..)}: calls the listener with the value; the answer carries the same value on.
     */
    public final Promise<T> then(Consumer<? super T> listener) {
        return listen(new Stage.Look<>(this, listener));
    }

    /**
     * The paper's {@code then((result, error) -> ..)}: calls the listener either way; the answer carries the same
     * outcome on.
     */
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
        Objects.requireNonNull(other, "other");
        Objects.requireNonNull(function, "function");
        Promise<R> both = thenCompose(mine -> other.<R>thenApply(theirs -> function.apply(mine, theirs)));
        other.register(new Relay(() -> {}, both)); // so that an error of the other is not one that nobody hears
        return both;
    }

    public final Promise<T> exceptionally(Function<Throwable, ? extends T> function) {
        Objects.requireNonNull(function, "function");
        return listen(new Stage.Handle<T, T>(this, (value, error) -> {
            return error == null ? Stage.present(value) : function.apply(error);
        }));
    }

    public final Promise<T> exceptionallyCompose(Function<Throwable, ? extends Promise<? extends T>> function) {
        Objects.requireNonNull(function, "function");
        return listen(new Stage.Compose<T, T>(this, Promise::of, function));
    }

    public final <R extends @Nullable Object> Promise<R> handle(
            BiFunction<? super @Nullable T, @Nullable Throwable, ? extends R> function) {
        return listen(new Stage.Handle<T, R>(this, function));
    }

    public final Promise<T> whenComplete(BiConsumer<? super @Nullable T, ? super @Nullable Throwable> listener) {
        return listen(new Stage.Observe<T>(this, listener));
    }

    /**
     * Follows this promise, and is rejected with a {@link TimeoutException} when the time is over first.
     *
     * <p><b>Threads.</b> Asked in a space, the limit is one of its timers. Asked outside every space, it needs no turn
     * of the space that this promise comes from, so it ends in time even if that is stalled, unless its clock is moved
     * by hand.
     *
     * <p><b>Errors.</b> A failure that comes after the time-out is reported to the error handler of this promise's
     * space, if no other listener is left.
     */
    public final Promise<T> orTimeout(Duration timeout) {
        return Limited.start(this, Objects.requireNonNull(timeout, "timeout"));
    }

    /**
     * Rejects this promise with a {@link CancellationException}, unless it is settled. A request that still waits in a
     * mailbox is then skipped; one that has begun goes on, and its answer is ignored.
     *
     * <p><b>Threads.</b> Any thread. A promise that was made in a space, by asking or listening there, is rejected when
     * that space gets to it.
     *
     * @return whether it was pending
     */
    public final boolean cancel() {
        boolean done = settleError(new CancellationException(this + " was cancelled"));
        if (done) {
            cancelled();
        }
        return done;
    }

    /**
     * It was cancelled by hand, on the calling thread. For promises whose work can be saved then.
     *
     * @hidden
     */
    protected void cancelled() {}

    /**
     * A time limit on this promise has passed, on the thread of its clock; {@link #isGivenUp} says whether anybody else
     * waits.
     *
     * @hidden
     */
    protected void timedOut() {}

    /**
     * A {@link CompletableFuture} that follows this promise; cancelling it does not reach back. Its own continuations
     * run on the thread that settles the promise, a space's or that of its time limits, and must not block it.
     */
    public final CompletableFuture<T> toCompletableFuture() {
        var future = new CompletableFuture<T>();
        register(new Relay(
                () -> {
                    Object outcome = Objects.requireNonNull(outcomeNow());
                    if (outcome instanceof Rejection rejection) {
                        future.completeExceptionally(rejection.error());
                    } else {
                        future.complete(valueOf(outcome));
                    }
                },
                this));
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

    /**
     * The first value; rejected when all are, with a {@link java.util.NoSuchElementException} that has their errors as
     * suppressed ones.
     */
    public static <T extends @Nullable Object> Promise<T> any(Collection<? extends Promise<? extends T>> promises) {
        return Gather.any(promises);
    }

    /**
     * The outcome of whichever is settled first; rejected with a {@link java.util.NoSuchElementException} if there is
     * none.
     */
    public static <T extends @Nullable Object> Promise<T> race(Collection<? extends Promise<? extends T>> promises) {
        return Gather.race(promises);
    }

    /** The promise that this one waits for, while it does. */
    @Nullable
    Promise<?> source() {
        return null;
    }

    /**
     * How far it has come, to be put behind its name in a message: empty, or beginning with a comma.
     *
     * @hidden
     */
    protected String progress() {
        return "";
    }

    final Outcome<T> outcome() {
        Object outcome = Objects.requireNonNull(outcomeNow());
        return outcome instanceof Rejection rejection
                ? new Outcome.Rejected<>(rejection.error())
                : new Outcome.Fulfilled<>(valueOf(outcome));
    }

    private <R extends @Nullable Object> Promise<R> listen(Stage<T, R> stage) {
        return stage.listen();
    }
}
