package io.troupe.bus.internal;

import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.promise.Promise;
import org.jspecify.annotations.Nullable;

/**
 * The answer of a request handler of this library to one request. The bus cancels it when no requester waits for it any
 * more, and with it the work.
 */
public final class CancellableAnswer<A> extends Promise<A> {
    private final Promise<?> work;

    /** @param answer settled when the work is */
    public CancellableAnswer(Promise<A> answer, Promise<?> work) {
        this.work = work;
        follow(answer);
    }

    @Override
    protected void cancelled() {
        work.cancel();
    }

    @Override
    protected @Nullable Home home() {
        return null;
    }

    @Override
    public String toString() {
        return "the answer of " + work;
    }
}
