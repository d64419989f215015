package io.troupe.actor;

import io.troupe.actor.SettledState.Rejection;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.QueueEntries;
import java.time.Duration;
import java.util.Collection;
import java.util.List;
import java.util.Objects;
import java.util.concurrent.CancellationException;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionException;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.TimeoutException;
import java.util.function.BiConsumer;
import java.util.function.BiFunction;
import java.util.function.Consumer;
import java.util.function.Function;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * A value that arrives later, or the error that came instead.
 *
 * <p><b>Role.</b> A request to an actor returns one immediately. It is settled exactly once: fulfilled with a value or
 * rejected with an error. Created by calling an actor, by {@link Deferred}, or by {@link #of}.
 *
 * {@snippet :
 * Promise<String> receipt = shop.price("lamp")
 *         .thenCompose(price -> shop.buy("lamp", price))
 *         .orTimeout(Duration.ofSeconds(2))
 *         .exceptionally(error -> "not bought: " + error.getMessage());
 * }
 *
 * <p><b>Threads.</b> Any thread. A listener runs on the thread of the actor space in which it was registered. A
 * listener registered outside every space runs in the promise's space. If the promise has none, it runs on the thread
 * that settles the promise, or on the registering thread if the promise is already settled. In a space it is an entry
 * of the callback queue, never a call on the stack of the settling thread.
 *
 * <p><b>Order.</b> Listeners of one space run in the order of registration; any number is allowed.
 *
 * <p><b>Cost.</b> A settled promise retains its outcome; the promise of a request also retains the arguments of the
 * call.
 *
 * <p><b>Errors.</b> Errors are not wrapped: {@link #exceptionally} receives the exception that the request threw. A
 * rejection without a listener is reported to the space's error handler.
 *
 * <p><b>Source.</b> Paper, sections 1 and 3.6; the names are those of {@link CompletableFuture}, and the paper's
 * {@code then}.
 */
public abstract class Promise<T extends @Nullable Object> extends Settleable<T> {
    Promise() {}

    Promise(Object outcome) {
        super(outcome);
    }

    // ---- factories of settled promises

    /** A fulfilled promise. It belongs to no space, so a listener registered outside every space runs immediately. */
    public static <T extends @Nullable Object> Promise<T> of(T value) {
        return new Settled<>(value);
    }

    /** A fulfilled promise without a value. */
    public static Promise<@Nullable Void> done() {
        return Settled.DONE;
    }

    /** A rejected promise. */
    public static <T extends @Nullable Object> Promise<T> failed(Throwable error) {
        Objects.requireNonNull(error, "error");
        var promise = new Deferred<T>();
        promise.reject(error);
        return promise;
    }

    /** A promise that follows a {@link CompletionStage}; a {@code CompletionException} is unwrapped. */
    public static <T extends @Nullable Object> Promise<T> from(CompletionStage<? extends T> stage) {
        Objects.requireNonNull(stage, "stage");
        var promise = new Deferred<T>();
        stage.whenComplete((value, error) -> {
            if (error == null) {
                promise.resolve(value);
            } else {
                boolean isWrapped = error instanceof CompletionException && error.getCause() != null;
                promise.reject(isWrapped ? error.getCause() : error);
            }
        });
        return promise;
    }

    // ---- state

    public final boolean isRejected() {
        return outcomeNow() instanceof Rejection;
    }

    public final boolean isCancelled() {
        return error() instanceof CancellationException;
    }

    /** The value if it is available, else null; a null value looks the same. */
    public final @Nullable T getNow() {
        Object outcome = outcomeNow();
        return outcome == null || outcome instanceof Rejection ? null : valueOf(outcome);
    }

    /** The error if it is rejected, else null. */
    public final @Nullable Throwable error() {
        return outcomeNow() instanceof Rejection rejection ? rejection.error() : null;
    }

    /**
     * Waits for the value; for threads outside every space.
     *
     * <p><b>Errors.</b> Throws the rejection's own error unchanged, even a checked one, never an
     * {@code ExecutionException}. To catch an {@code IOException}, for example, catch {@code Exception} and test its
     * type. The stack trace is that of the thread where the error was created, without the caller's frames.
     *
     * @throws IllegalStateException on the thread of an actor space, which must never block; use {@code then} or
     *     {@code thenCompose}
     * @throws TimeoutException if it is not settled in time
     */
    public final T get(Duration timeout) throws TimeoutException, InterruptedException {
        Listeners.Waiter.await(this, Objects.requireNonNull(timeout, "timeout"));
        return valueOrThrow();
    }

    /**
     * Waits for the value in the body of {@code ActorSpace.sequential(..)}; the space runs other work meanwhile.
     *
     * <p><b>Errors.</b> Throws the rejection's own error unchanged, even a checked one.
     *
     * @throws IllegalStateException anywhere else; the message names the alternative
     * @throws CancellationException if the actor on whose behalf the body runs has stopped meanwhile, or its space has
     *     been closed
     */
    public final T await() {
        Home here = Home.current();
        if (here == null) {
            throw new IllegalStateException(
                    "await() belongs in the body of ActorSpace.sequential(..); in a Kotlin coroutine: coAwait(); a thread outside the space waits with get(Duration)");
        }
        if (isDone()) {
            markHandled();
        } else {
            here.await(this);
        }
        return valueOrThrow();
    }

    private T valueOrThrow() {
        Object outcome = Objects.requireNonNull(outcomeNow());
        if (outcome instanceof Rejection rejection) {
            throw QueueEntries.rethrow(rejection.error());
        }
        return valueOf(outcome);
    }

    // ---- listeners and derived promises

    /**
     * Calls the listener with the value, as {@code then(result -> ..)} of the paper; the returned promise has the same
     * value.
     */
    public final Promise<T> then(Consumer<? super T> listener) {
        return listen(new Stage.Look<>(this, listener));
    }

    /**
     * Calls the listener with the value or the error, as {@code then((result, error) -> ..)} of the paper; see
     * {@link #whenComplete}.
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
        // a listener, so that an error of the other promise is not reported as unhandled
        other.register(new Listeners.Inline(() -> {}, both));
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

    /**
     * Calls the listener with the value or the error; the returned promise has the same outcome. An error that the
     * listener was given is not reported, even if the returned promise has no listener.
     */
    public final Promise<T> whenComplete(BiConsumer<? super @Nullable T, ? super @Nullable Throwable> listener) {
        return listen(new Stage.Observe<T>(this, listener, true));
    }

    /**
     * Calls the listener with the value or the error, at the end of a chain: like {@link #whenComplete}, without a
     * further promise. What the listener throws is reported.
     *
     * {@snippet :
     * greeter.greet("Ada").onSettled((answer, error) -> log.add(error == null ? answer : "nobody is there"));
     * }
     */
    public final void onSettled(BiConsumer<? super @Nullable T, ? super @Nullable Throwable> listener) {
        whenComplete(listener);
    }

    /**
     * Calls the listener with the error, if there is one, at the end of a chain. What the listener throws is reported.
     *
     * {@snippet :
     * greeter.greet("Ada").thenAccept(log::add).onRejected(error -> log.add("nobody is there"));
     * }
     */
    public final void onRejected(Consumer<? super Throwable> listener) {
        Objects.requireNonNull(listener, "listener");
        whenComplete((value, error) -> {
            if (error != null) {
                listener.accept(error);
            }
        });
    }

    /**
     * A {@code finally}: runs an action after the value or the error; the returned promise then has the same outcome.
     * An exception of the action is the outcome instead, with an error of this promise as a suppressed exception.
     */
    public final Promise<T> eventually(Runnable action) {
        Objects.requireNonNull(action, "action");
        return listen(new Stage.Observe<T>(this, (value, error) -> action.run(), false));
    }

    /** Like {@link #eventually(Runnable)}, and waits for the promise that the action returns. */
    public final Promise<T> eventually(Supplier<? extends Promise<?>> action) {
        Objects.requireNonNull(action, "action");
        return listen(new Stage.Compose<T, T>(
                this,
                value -> action.get().thenApply(done -> value),
                error -> Combinators.finallyFailed(action, error)));
    }

    /**
     * Returns a promise that follows this one, and is rejected with a {@link TimeoutException} if the time is over
     * first.
     *
     * <p><b>Threads.</b> Called in a space, the limit is a timer of that space. Called outside every space, it does not
     * depend on the thread of this promise's space: it expires in time even if that thread is stalled, unless the space
     * uses a manual clock.
     *
     * <p>A request that still waits in a mailbox is not begun if the time limits of all its listeners have passed: it
     * is rejected with a {@link CancellationException} when its turn comes.
     *
     * <p><b>Errors.</b> A failure after the time-out is reported to the error handler of this promise's space, if no
     * other listener is left.
     */
    public final Promise<T> orTimeout(Duration timeout) {
        return TimeLimitedPromise.start(this, Objects.requireNonNull(timeout, "timeout"), null);
    }

    /**
     * Returns a promise that follows this one, and is fulfilled with a value if the time is over first; otherwise like
     * {@link #orTimeout}.
     */
    public final Promise<T> completeOnTimeout(T value, Duration timeout) {
        Objects.requireNonNull(timeout, "timeout");
        return TimeLimitedPromise.start(this, timeout, new Outcome.Fulfilled<>(value));
    }

    /**
     * Rejects this promise with a {@link CancellationException}, unless it is settled. A request still waiting in a
     * mailbox is then dropped. One that has begun continues, and its result is ignored.
     *
     * <p><b>Threads.</b> Any thread. A promise made on the thread of a space, by a call or as a listener there, is
     * rejected when that thread processes the cancellation.
     *
     * @return whether it was pending
     */
    public final boolean cancel() {
        boolean done = settleError(new CancellationException(name() + " was cancelled"));
        if (done) {
            cancelled();
        }
        return done;
    }

    /**
     * Called on the cancelling thread after this promise was cancelled. For promises whose work can then be dropped.
     */
    void cancelled() {}

    /**
     * Called on the thread of the timer when a time limit on this promise has passed; {@link #isGivenUp} is false if
     * other listeners remain.
     */
    void timedOut() {}

    /**
     * Returns a {@link CompletableFuture} that follows this promise; cancelling the future does not cancel the promise.
     * Dependents of the future run on the thread that settles the promise, a space's or that of its time limits, and
     * must not block it.
     */
    public final CompletableFuture<T> toCompletableFuture() {
        var future = new CompletableFuture<T>();
        register(new Listeners.Inline(
                () -> {
                    Object outcome = Objects.requireNonNull(outcomeNow());
                    if (outcome instanceof Rejection rejection) {
                        future.completeExceptionally(rejection.error());
                    } else {
                        future.complete(valueOf(outcome));
                    }
                },
                future::isDone));
        return future;
    }

    // ---- combinators

    /** All values, in the order of the arguments; rejected with the first error. */
    public static <T extends @Nullable Object> Promise<List<T>> all(
            Collection<? extends Promise<? extends T>> promises) {
        return Combinators.all(promises);
    }

    /** All outcomes, in the order of the arguments; never rejected. */
    public static <T extends @Nullable Object> Promise<List<Outcome<T>>> allSettled(
            Collection<? extends Promise<? extends T>> promises) {
        return Combinators.allSettled(promises);
    }

    /**
     * The first value. If all promises are rejected, rejected with a {@link java.util.NoSuchElementException} that has
     * their errors as suppressed exceptions.
     */
    public static <T extends @Nullable Object> Promise<T> any(Collection<? extends Promise<? extends T>> promises) {
        return Combinators.any(promises);
    }

    /**
     * The outcome of the promise that is settled first; rejected with a {@link java.util.NoSuchElementException} if
     * there are none.
     */
    public static <T extends @Nullable Object> Promise<T> race(Collection<? extends Promise<? extends T>> promises) {
        return Combinators.race(promises);
    }

    /** What this promise is called in messages: without its value, which may be secret. */
    String name() {
        return toString();
    }

    final String withOutcome(String name) {
        return PromiseText.withOutcome(name, this);
    }

    /** The promise for which this one is waiting, or null. */
    @Nullable
    Promise<?> source() {
        return null;
    }

    /** A progress note for error messages, put behind the promise's name: empty, or beginning with a comma. */
    String progress() {
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

    /**
     * True for an error of the virtual machine, except a stack overflow or an out-of-memory error: it is reported
     * although it also rejects a promise.
     */
    static boolean isVirtualMachineError(Throwable error) {
        return error instanceof VirtualMachineError
                && !(error instanceof StackOverflowError)
                && !(error instanceof OutOfMemoryError);
    }

    /** A promise that was fulfilled when it was created; it has no home. */
    static final class Settled<T extends @Nullable Object> extends Promise<T> {
        static final Promise<@Nullable Void> DONE = new Settled<>(null);

        Settled(T value) {
            super(asOutcome(value));
        }

        @Override
        @Nullable
        Home home() {
            return null;
        }

        @Override
        public String toString() {
            return PromiseText.withOutcome("promise", this);
        }
    }
}
