package io.troupe.actor.promise;

import org.jspecify.annotations.Nullable;

/** A promise that was fulfilled when it was created; it has no home. */
final class Settled<T extends @Nullable Object> extends Promise<T> {
    static final Promise<@Nullable Void> DONE = new Settled<>(null);

    Settled(T value) {
        super(asOutcome(value));
    }

    @Override
    protected @Nullable Home home() {
        return null;
    }

    @Override
    protected boolean isLocal() {
        return false;
    }

    @Override
    protected void run() {
        throw new IllegalStateException("a settled promise is never queued");
    }

    @Override
    public String toString() {
        return PromiseText.withOutcome("promise", this);
    }
}
