package io.troupe.actor;

import io.troupe.actor.SettledState.Rejection;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.QueueEntry;
import io.troupe.actor.internal.loop.TurnOwner;
import java.util.Objects;
import java.util.concurrent.CancellationException;
import java.util.function.BiConsumer;
import java.util.function.BiFunction;
import java.util.function.Consumer;
import java.util.function.Function;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * A listener and the promise of its result, in one object: {@code S} is the type of the value it waits for, {@code T}
 * that of its result. It runs in the space, and on behalf of the actor, that registered it. When it runs it drops its
 * source and its function, so that a retained promise retains only its outcome.
 */
abstract class Stage<S extends @Nullable Object, T extends @Nullable Object> extends Promise<T> {
    private @Nullable Promise<S> source;
    private final @Nullable TurnOwner owner;

    Stage(Promise<S> source) {
        this.source = source;
        Home from = source.home();
        if (from != null && from.isCurrent()) {
            this.owner = from.owner();
        } else {
            Home here = Home.current();
            this.owner = here != null ? here.owner() : from != null ? from.outsider() : null;
        }
    }

    /** Registers this listener with its source; returns itself. */
    final Stage<S, T> listen() {
        Promise<S> from = Objects.requireNonNull(source);
        from.register(this, owner != null && owner.home() == from.home() && !owner.isOutside());
        return this;
    }

    // ---- functions that run in the context of the registering thread, if its home carries contexts

    private @Nullable Supplier<Runnable> context() {
        return owner == null ? null : owner.home().captureContext();
    }

    final <A extends @Nullable Object, R extends @Nullable Object> Function<A, R> inContext(Function<A, R> function) {
        Objects.requireNonNull(function, "function");
        var context = context();
        return context == null
                ? function
                : value -> {
                    Runnable end = context.get();
                    try {
                        return function.apply(value);
                    } finally {
                        end.run();
                    }
                };
    }

    final <A extends @Nullable Object> Consumer<A> listenerInContext(Consumer<A> listener) {
        Objects.requireNonNull(listener, "listener");
        var context = context();
        return context == null
                ? listener
                : value -> {
                    Runnable end = context.get();
                    try {
                        listener.accept(value);
                    } finally {
                        end.run();
                    }
                };
    }

    final <A extends @Nullable Object, B extends @Nullable Object, R extends @Nullable Object>
            BiFunction<A, B, R> inContext(BiFunction<A, B, R> function) {
        Objects.requireNonNull(function, "function");
        var context = context();
        return context == null
                ? function
                : (value, error) -> {
                    Runnable end = context.get();
                    try {
                        return function.apply(value, error);
                    } finally {
                        end.run();
                    }
                };
    }

    final <A extends @Nullable Object, B extends @Nullable Object> BiConsumer<A, B> listenerInContext(
            BiConsumer<A, B> listener) {
        Objects.requireNonNull(listener, "listener");
        var context = context();
        return context == null
                ? listener
                : (value, error) -> {
                    Runnable end = context.get();
                    try {
                        listener.accept(value, error);
                    } finally {
                        end.run();
                    }
                };
    }

    /** Queues this listener at its home. */
    final void dispatch() {
        Home home = owner == null ? Home.current() : owner.home();
        if (home == null) {
            Listeners.runDetached(this);
        } else {
            home.enqueue(this);
        }
    }

    /** Like {@link #dispatch()}; called on the thread of {@code here}, which need not be this listener's home. */
    final void dispatch(Home here) {
        if (owner != null && owner.home() == here) {
            here.enqueueAtHome(this);
        } else {
            dispatch();
        }
    }

    /**
     * Like {@link #dispatch(Home)}, but returns this listener, instead of queueing it, if it would be run next; else
     * null.
     */
    final @Nullable QueueEntry returnOrEnqueue(Home here) {
        if (owner != null && owner.home() == here && here.isNextCallbackFirst()) {
            return this;
        }
        dispatch(here);
        return null;
    }

    /** Queues this listener behind those that another thread has queued at its home. */
    final void dispatchAsRemote() {
        if (owner == null) {
            dispatch();
        } else {
            owner.home().enqueueAsRemote(this);
        }
    }

    /** True if it runs on a thread other than the calling one. */
    final boolean isElsewhere() {
        return owner != null && !owner.home().isCurrent();
    }

    /** Begins the listener's turn: the outcome of the source, or null if nothing is left to do. */
    final @Nullable Object begin() {
        Promise<S> settled = Objects.requireNonNull(source);
        source = null;
        Object outcome = settled.outcomeForListener();
        if (isDone()) {
            return null; // cancelled meanwhile
        }
        if (owner != null) {
            owner.home().begin(owner.isOutside() ? owner.home().itself() : owner);
            if (owner.isOver()) {
                giveUp(outcome);
                return null;
            }
        } else if (Home.current() != null) {
            Home.current().beginForItself();
        }
        return outcome;
    }

    /**
     * An exception of the listener rejects the promise of its result, and may be a failure of its owner; an error of
     * the virtual machine goes on.
     */
    @Override
    protected final void threw(Throwable thrown) {
        settleError(thrown);
        if (owner != null && owner.listenerFailed(thrown)) {
            markHandled(); // reported there
        } else if (isVirtualMachineError(thrown)) {
            throw (VirtualMachineError) thrown;
        }
    }

    /** Rejects this promise because its owner has ended; passes the source's error on, so that it is not lost. */
    private void giveUp(Object outcome) {
        settleError(
                outcome instanceof Rejection rejection
                        ? rejection.error()
                        : new CancellationException("the actor that waited for this has been stopped: " + owner));
    }

    @Override
    final @Nullable Home home() {
        return owner == null ? null : owner.home();
    }

    @Override
    final boolean isLocal() {
        return owner != null && !owner.isOutside();
    }

    @Override
    final boolean madeOutside() {
        return owner != null && owner.isOutside();
    }

    @Override
    protected final boolean isIdle() {
        return isDone();
    }

    @Override
    final @Nullable Promise<?> source() {
        return source;
    }

    @Override
    final String name() {
        return PromiseText.describe(this);
    }

    @Override
    public String toString() {
        return PromiseText.withOutcome(PromiseText.describe(this), this);
    }

    /**
     * Returns a value that is null only where the type parameter allows it: the caller of {@code settleValue} decided
     * that.
     */
    @SuppressWarnings("NullAway")
    static <V extends @Nullable Object> V present(@Nullable V value) {
        return value;
    }

    @SuppressWarnings("unchecked") // the source settles with values of type S
    final S sourceValue(Object outcome) {
        return (S) plainValue(outcome);
    }

    /** Maps a value; an error is passed on. */
    static final class Transform<S extends @Nullable Object, T extends @Nullable Object> extends Stage<S, T> {
        private @Nullable Function<? super S, ? extends T> function;

        Transform(Promise<S> source, Function<? super S, ? extends T> function) {
            super(source);
            this.function = inContext(function);
        }

        @Override
        protected @Nullable QueueEntry serve() {
            var apply = Objects.requireNonNull(function);
            function = null;
            Object outcome = begin();
            if (outcome instanceof Rejection rejection) {
                settleErrorAtHome(rejection.error());
            } else if (outcome != null) {
                settleValueAtHome(apply.apply(sourceValue(outcome)));
            }
            return null;
        }
    }

    /** Calls a listener with the value and passes the value on; an error is passed on. */
    static final class Look<S extends @Nullable Object> extends Stage<S, S> {
        private @Nullable Consumer<? super S> listener;

        Look(Promise<S> source, Consumer<? super S> listener) {
            super(source);
            this.listener = listenerInContext(listener);
        }

        @Override
        protected @Nullable QueueEntry serve() {
            var look = Objects.requireNonNull(listener);
            listener = null;
            Object outcome = begin();
            if (outcome instanceof Rejection rejection) {
                settleErrorAtHome(rejection.error());
            } else if (outcome != null) {
                look.accept(sourceValue(outcome));
                settleAtHome(outcome);
            }
            return null;
        }
    }

    /** Maps a value or an error to a value. */
    static final class Handle<S extends @Nullable Object, T extends @Nullable Object> extends Stage<S, T> {
        private @Nullable BiFunction<? super @Nullable S, @Nullable Throwable, ? extends T> function;

        Handle(Promise<S> source, BiFunction<? super @Nullable S, @Nullable Throwable, ? extends T> function) {
            super(source);
            this.function = inContext(function);
        }

        @Override
        protected @Nullable QueueEntry serve() {
            var apply = Objects.requireNonNull(function);
            function = null;
            Object outcome = begin();
            if (outcome instanceof Rejection rejection) {
                settleValueAtHome(apply.apply(null, rejection.error()));
            } else if (outcome != null) {
                settleValueAtHome(apply.apply(sourceValue(outcome), null));
            }
            return null;
        }
    }

    /**
     * Calls a listener with the outcome and passes the outcome on; the source's error is added as suppressed to an
     * exception of the listener.
     */
    static final class Observe<S extends @Nullable Object> extends Stage<S, S> {
        private @Nullable BiConsumer<? super @Nullable S, ? super @Nullable Throwable> listener;

        private final boolean receivesErrors;

        /** @param receivesErrors whether an error that the listener was given needs no other listener */
        Observe(
                Promise<S> source,
                BiConsumer<? super @Nullable S, ? super @Nullable Throwable> listener,
                boolean receivesErrors) {
            super(source);
            this.receivesErrors = receivesErrors;
            this.listener = listenerInContext(listener);
        }

        @Override
        protected @Nullable QueueEntry serve() {
            var look = Objects.requireNonNull(listener);
            listener = null;
            Object outcome = begin();
            if (outcome instanceof Rejection rejection) {
                observe(look, rejection.error());
            } else if (outcome != null) {
                look.accept(sourceValue(outcome), null);
                settleAtHome(outcome);
            }
            return null;
        }

        private void observe(BiConsumer<? super @Nullable S, ? super @Nullable Throwable> look, Throwable error) {
            try {
                look.accept(null, error);
            } catch (Throwable thrown) {
                if (error != thrown) {
                    thrown.addSuppressed(error);
                }
                throw thrown;
            }
            settleErrorAtHome(error);
            if (receivesErrors) {
                markHandled();
            }
        }
    }

    /** Maps a value (or, if there is a function for it, an error) to a promise and follows that. */
    static final class Compose<S extends @Nullable Object, T extends @Nullable Object> extends Stage<S, T> {
        private @Nullable Function<? super S, ? extends Promise<? extends T>> function;
        private @Nullable Function<Throwable, ? extends Promise<? extends T>> rescue;

        Compose(
                Promise<S> source,
                Function<? super S, ? extends Promise<? extends T>> function,
                @Nullable Function<Throwable, ? extends Promise<? extends T>> rescue) {
            super(source);
            this.function = inContext(function);
            this.rescue = rescue == null ? null : inContext(rescue);
        }

        @Override
        protected @Nullable QueueEntry serve() {
            var apply = Objects.requireNonNull(function);
            var rescueBy = rescue;
            function = null;
            rescue = null;
            Object outcome = begin();
            if (!(outcome instanceof Rejection rejection)) {
                if (outcome != null) {
                    followAnswer(apply.apply(sourceValue(outcome)));
                }
            } else if (rescueBy == null) {
                settleErrorAtHome(rejection.error());
            } else {
                followAnswer(rescueBy.apply(rejection.error()));
            }
            return null;
        }

        private void followAnswer(@Nullable Promise<? extends T> answer) {
            QueueEntry next = followAtHome(Objects.requireNonNull(answer, "the function returned null, not a promise"));
            if (next
                    instanceof
                    Stage<?, ?> listener) { // queued, so that a chain of such functions gives other entries their turn
                listener.dispatch();
            }
        }
    }
}
