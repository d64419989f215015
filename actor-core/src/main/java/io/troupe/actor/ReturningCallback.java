package io.troupe.actor;

import io.troupe.actor.promise.Node;
import io.troupe.actor.promise.Owner;
import org.jspecify.annotations.Nullable;

/** A callback on its way through a proxy: what the actor sends becomes entries of the caller's callback queue. */
final class ReturningCallback<T extends @Nullable Object> implements Callback<T> {
    private final Callback<T> reader;
    private final ActorSpace home;
    private final Owner owner;
    private volatile boolean ended;
    private volatile boolean readerGone;

    private ReturningCallback(Callback<T> reader, ActorSpace home, Owner owner) {
        this.reader = reader;
        this.home = home;
        this.owner = owner;
    }

    /** The callback as the actor gets it; one that has come through a proxy before keeps its first reader. */
    static <T extends @Nullable Object> @Nullable Callback<T> wrap(@Nullable Callback<T> callback, ActorSpace callee) {
        if (callback == null || callback instanceof ReturningCallback) {
            return callback;
        }
        ActorSpace caller = ActorSpace.current();
        return caller == null
                ? new ReturningCallback<>(callback, callee, callee.ownself())
                : new ReturningCallback<>(callback, caller, caller.currentOwner());
    }

    @Override
    public void accept(@Nullable T result, @Nullable Throwable error) {
        if (error != null) {
            fail(error);
        } else {
            checkNotEnded();
            send(() -> reader.accept(result, null));
        }
    }

    @Override
    public void finish() {
        checkNotEnded();
        ended = true;
        send(reader::finish);
    }

    @Override
    public void fail(Throwable error) {
        checkNotEnded();
        ended = true;
        send(() -> reader.fail(error));
    }

    /** Nobody will ever send anything: ends it, unless it has ended. */
    void abandon(Throwable error) {
        if (!ended) {
            fail(error);
        }
    }

    @Override
    public boolean isCancelled() {
        return readerGone || reader.isCancelled();
    }

    private void checkNotEnded() {
        if (ended) {
            throw new IllegalStateException("this callback has been finished or failed before: nothing can follow");
        }
    }

    private void send(Runnable delivery) {
        if (!isCancelled()) {
            home.enqueueCallback(new Delivery(delivery));
        }
    }

    private final class Delivery extends Node {
        private final Runnable delivery;

        Delivery(Runnable delivery) {
            this.delivery = delivery;
        }

        @Override
        protected void run() {
            if (!(owner instanceof Life life)) {
                home.runGuarded(delivery);
            } else if (!life.run("a listener", delivery)) {
                readerGone = true; // the actor that listened has stopped
            }
        }
    }
}
