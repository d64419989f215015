package io.troupe.actor.promise;

/** Sentinel: the promise was already settled. */
final class Claim extends Node {
    static final Node REFUSED = new Claim();

    private Claim() {}

    @Override
    protected void run() {
        throw new IllegalStateException("the sign of a refused claim is never run");
    }
}
