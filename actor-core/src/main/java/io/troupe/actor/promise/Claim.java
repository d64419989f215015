package io.troupe.actor.promise;

/** The answer that is no list of listeners: somebody else has settled the promise before. */
final class Claim extends Node {
    static final Node REFUSED = new Claim();

    private Claim() {}

    @Override
    protected void run() {
        throw new IllegalStateException("the sign of a refused claim is never run");
    }
}
