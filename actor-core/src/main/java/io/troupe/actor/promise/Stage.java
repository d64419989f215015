package io.troupe.actor.promise;

import java.util.Objects;
import java.util.concurrent.CancellationException;
import java.util.function.BiConsumer;
import java.util.function.BiFunction;
import java.util.function.Function;
import org.jspecify.annotations.Nullable;

/**
 * A listener and the promise of what it makes, in one object: {@code S} is the value it waits for, {@code T} the one it promises.
 * Remembers the space and the actor that registered it, and runs there.
 */
abstract class Stage<S extends @Nullable Object, T extends @Nullable Object> extends Promise<T> {
    private @Nullable Promise<S> source;
    private final @Nullable Home home;
    private final @Nullable Object owner;
    private final boolean madeOutside;

    Stage(Promise<S> source) {
        this.source = source;
        Home from = source.home();
        this.home = from != null && from.isCurrent() ? from : orElse(Home.current(), from);
        this.madeOutside = home != null && !home.isCurrent();
        this.owner = home != null && !madeOutside ? home.owner() : null;
    }

    private static @Nullable Home orElse(@Nullable Home first, @Nullable Home second) {
        return first != null ? first : second;
    }

    /** Reacts to how the source ended; may throw. */
    abstract void react(Promise<S> settled) throws Throwable;

    final void dispatch() {
        if (home == null) {
            fire();
        } else {
            home.enqueue(this);
        }
    }

    @Override
    protected final void run() {
        if (owner == null) {
            fire();
        } else if (!Objects.requireNonNull(home).runFor(owner, this::fire)) {
            settleError(new CancellationException("the actor that waited for this has been stopped: " + owner));
        }
    }

    private void fire() {
        Promise<S> settled = Objects.requireNonNull(source);
        source = null;
        if (isDone()) {
            return; // cancelled meanwhile
        }
        try {
            react(settled);
        } catch (Throwable thrown) {
            settleError(thrown);
            Errors.rethrowIfFatal(thrown);
        }
    }

    @Override
    protected final @Nullable Home home() {
        return home;
    }

    @Override
    protected final boolean madeOutside() {
        return madeOutside;
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

    /** Value in, value out; errors pass by. */
    static final class Transform<S extends @Nullable Object, T extends @Nullable Object> extends Stage<S, T> {
        private final Function<? super S, ? extends T> function;

        Transform(Promise<S> source, Function<? super S, ? extends T> function) {
            super(source);
            this.function = Objects.requireNonNull(function, "function");
        }

        @Override
        void react(Promise<S> settled) {
            Throwable error = settled.error();
            if (error != null) {
                settleError(error);
            } else {
                settleValue(function.apply(present(settled.getNow())));
            }
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
        void react(Promise<S> settled) {
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
        void react(Promise<S> settled) {
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
        void react(Promise<S> settled) {
            Throwable error = settled.error();
            if (error == null) {
                follow(Objects.requireNonNull(
                        function.apply(present(settled.getNow())), "the function answered null, not a promise"));
            } else if (rescue == null) {
                settleError(error);
            } else {
                follow(Objects.requireNonNull(rescue.apply(error), "the function answered null, not a promise"));
            }
        }
    }
}
