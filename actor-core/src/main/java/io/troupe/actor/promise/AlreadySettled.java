package io.troupe.actor.promise;

/** Sentinel: the promise was already settled. */
final class AlreadySettled extends Node {
    static final Node INSTANCE = new AlreadySettled();

    private AlreadySettled() {}

    @Override
    protected void run() {
        throw new IllegalStateException("the sign of a refused claim is never run");
    }
}
