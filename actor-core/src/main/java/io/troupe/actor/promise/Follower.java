package io.troupe.actor.promise;

/** Listens so that one promise ends as another one does. */
class Follower extends Node {
    final Settleable<?> promise;

    Follower(Settleable<?> promise) {
        this.promise = promise;
    }

    /** The leader is settled; the promise is about to be. */
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
