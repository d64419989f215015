package io.troupe.actor.promise;

import java.util.Objects;
import java.util.concurrent.CancellationException;
import java.util.function.BiConsumer;
import java.util.function.BiFunction;
import java.util.function.Consumer;
import java.util.function.Function;
import org.jspecify.annotations.Nullable;

/**
 * A listener and the promise of what it makes, in one object: {@code S} is the value it waits for, {@code T} the one it promises.
 * Remembers the space and the actor that registered it, and runs there.
 */
abstract class Stage<S extends @Nullable Object, T extends @Nullable Object> extends Promise<T> {
    private @Nullable Promise<S> source;
    private final @Nullable Owner owner;

    Stage(Promise<S> source) {
        this.source = source;
        Home from = source.home();
        Home here = from != null && from.isCurrent() ? from : Home.current();
        this.owner = here != null ? here.owner() : from != null ? from.outsider : null;
    }

    /** Reacts to how the source ended; may throw. */
    abstract void react(Promise<S> settled, Object outcome) throws Throwable;

    /** Queues it where it is to run. */
    final void dispatch() {
        Home home = owner == null ? Home.current() : owner.home();
        if (home == null) {
            Detached.run(this);
        } else {
            home.enqueue(this);
        }
    }

    /** Whether it runs on another thread than the calling one. */
    final boolean isElsewhere() {
        return owner != null && !owner.home().isCurrent();
    }

    @Override
    protected final void run() {
        Promise<S> settled = Objects.requireNonNull(source);
        source = null;
        if (isDone()) {
            return; // cancelled meanwhile
        }
        Object outcome = Objects.requireNonNull(settled.outcomeNow());
        if (!begin()) {
            giveUp(outcome);
            return;
        }
        try {
            react(settled, outcome);
        } catch (Throwable thrown) {
            settleError(thrown);
            Errors.rethrowIfFatal(thrown);
        }
    }

    private boolean begin() {
        if (owner != null) {
            owner.home().begin(owner);
            return !owner.isOver();
        }
        Home here = Home.current();
        if (here != null) {
            here.beginForItself();
        }
        return true;
    }

    /** Nobody is there to listen any more; an error that nobody else has seen is not lost with them. */
    private void giveUp(Object outcome) {
        settleError(
                outcome instanceof Rejection rejection
                        ? rejection.error()
                        : new CancellationException("the actor that waited for this has been stopped: " + owner));
    }

    @Override
    protected final @Nullable Home home() {
        return owner == null ? null : owner.home();
    }

    @Override
    protected final boolean isLocal() {
        return owner != null && !owner.isOutside();
    }

    @Override
    protected final boolean madeOutside() {
        return owner != null && owner.isOutside();
    }

    @Override
    final boolean isIdle() {
        return isDone();
    }

    @Override
    protected String progress() {
        Promise<S> from = source;
        return from == null ? "" : from.progress();
    }

    @Override
    public String toString() {
        Promise<S> from = source;
        return from == null ? "promise" : "promise after " + from;
    }

    /** A null where the type parameter says whether null is allowed: the caller of {@code settleValue} has decided that. */
    @SuppressWarnings("NullAway")
    static <V extends @Nullable Object> V present(@Nullable V value) {
        return value;
    }

    /** What comes of a value; an error passes by. */
    abstract static class OfValue<S extends @Nullable Object, T extends @Nullable Object> extends Stage<S, T> {
        OfValue(Promise<S> source) {
            super(source);
        }

        abstract void react(S value) throws Throwable;

        @Override
        final void react(Promise<S> settled, Object outcome) throws Throwable {
            if (outcome instanceof Rejection rejection) {
                settleError(rejection.error());
            } else {
                react(settled.valueOf(outcome));
            }
        }
    }

    /** Value in, value out. */
    static final class Transform<S extends @Nullable Object, T extends @Nullable Object> extends OfValue<S, T> {
        private final Function<? super S, ? extends T> function;

        Transform(Promise<S> source, Function<? super S, ? extends T> function) {
            super(source);
            this.function = Objects.requireNonNull(function, "function");
        }

        @Override
        void react(S value) {
            settleValue(function.apply(value));
        }
    }

    /** Looks at a value and passes it on. */
    static final class Look<S extends @Nullable Object> extends OfValue<S, S> {
        private final Consumer<? super S> listener;

        Look(Promise<S> source, Consumer<? super S> listener) {
            super(source);
            this.listener = Objects.requireNonNull(listener, "listener");
        }

        @Override
        void react(S value) {
            listener.accept(value);
            settleValue(value);
        }
    }

    /** Value or error in, value out. */
    static final class Handle<S extends @Nullable Object, T extends @Nullable Object> extends Stage<S, T> {
        private final BiFunction<? super @Nullable S, @Nullable Throwable, ? extends T> function;

        Handle(Promise<S> source, BiFunction<? super @Nullable S, @Nullable Throwable, ? extends T> function) {
            super(source);
            this.function = Objects.requireNonNull(function, "function");
        }

        @Override
        void react(Promise<S> settled, Object outcome) {
            settleValue(function.apply(settled.getNow(), settled.error()));
        }
    }

    /** Looks, and passes the outcome on; an error of the listener is added to the one that is there. */
    static final class Observe<S extends @Nullable Object> extends Stage<S, S> {
        private final BiConsumer<? super @Nullable S, ? super @Nullable Throwable> listener;

        Observe(Promise<S> source, BiConsumer<? super @Nullable S, ? super @Nullable Throwable> listener) {
            super(source);
            this.listener = Objects.requireNonNull(listener, "listener");
        }

        @Override
        void react(Promise<S> settled, Object outcome) {
            Throwable error = settled.error();
            try {
                listener.accept(settled.getNow(), error);
            } catch (Throwable thrown) {
                if (error != null && error != thrown) {
                    thrown.addSuppressed(error);
                }
                throw thrown;
            }
            follow(settled);
        }
    }

    /** Value (or, if asked for, error) in, promise out, followed. */
    static final class Compose<S extends @Nullable Object, T extends @Nullable Object> extends Stage<S, T> {
        private final Function<? super S, ? extends Promise<? extends T>> function;
        private final @Nullable Function<Throwable, ? extends Promise<? extends T>> rescue;

        Compose(
                Promise<S> source,
                Function<? super S, ? extends Promise<? extends T>> function,
                @Nullable Function<Throwable, ? extends Promise<? extends T>> rescue) {
            super(source);
            this.function = Objects.requireNonNull(function, "function");
            this.rescue = rescue;
        }

        @Override
        void react(Promise<S> settled, Object outcome) {
            if (!(outcome instanceof Rejection rejection)) {
                follow(Objects.requireNonNull(
                        function.apply(settled.valueOf(outcome)), "the function answered null, not a promise"));
            } else if (rescue == null) {
                settleError(rejection.error());
            } else {
                follow(Objects.requireNonNull(
                        rescue.apply(rejection.error()), "the function answered null, not a promise"));
            }
        }
    }
}
