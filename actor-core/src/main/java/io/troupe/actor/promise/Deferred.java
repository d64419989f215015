package io.troupe.actor.promise;

import org.jspecify.annotations.Nullable;

/**
 * A promise that is settled by hand.
 *
 * <p><b>Role.</b> For whoever answers later than the call returns: hand out the promise, keep the deferred. Until it is settled, the actor keeps the request
 * with its arguments; if the actor ends first, the request is rejected, and settling the deferred has no effect on it.
 * <p><b>Threads.</b> Any thread may settle it; the first one wins.
 */
public final class Deferred<T extends @Nullable Object> extends Promise<T> {
    private final @Nullable Home home;
    private final boolean madeOutside;

    /** Belongs to the actor space whose thread is calling, if any. */
    public Deferred() {
        this(Home.current());
    }

    /** Belongs to that home: its listeners from outside run there, and a rejection nobody hears is reported there. */
    public Deferred(@Nullable Home home) {
        this.home = home;
        this.madeOutside = home != null && !home.isCurrent();
    }

    @Override
    protected boolean madeOutside() {
        return madeOutside;
    }

    /** Fulfils the promise; false if it was settled before. */
    public boolean resolve(T value) {
        return settleValue(value);
    }

    /** Rejects the promise; false if it was settled before. */
    public boolean reject(Throwable error) {
        return settleError(error);
    }

    /** Settles the promise as the other one is, as soon as it is. */
    public void resolveFrom(Promise<? extends T> other) {
        follow(other);
    }

    @Override
    protected @Nullable Home home() {
        return home;
    }

    @Override
    protected boolean isLocal() {
        return false;
    }

    @Override
    protected void run() {
        throw new IllegalStateException("a deferred promise is never queued");
    }

    @Override
    public String toString() {
        return "promise";
    }
}
