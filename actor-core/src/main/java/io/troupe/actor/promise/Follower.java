package io.troupe.actor.promise;

/** A listener that settles one promise with the outcome of another. */
class Follower extends Node {
    final Settleable<?> promise;

    Follower(Settleable<?> promise) {
        this.promise = promise;
    }

    /** Called when the source is settled, before the following promise is. */
    void beforeSettling() {}

    @Override
    protected final void run() {
        throw new IllegalStateException("a follower is settled by its leader, not run");
    }

    @Override
    final boolean isIdle() {
        return promise.isDone();
    }
}
