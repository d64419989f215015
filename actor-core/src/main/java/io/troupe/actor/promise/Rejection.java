package io.troupe.actor.promise;

/** The error of a rejected promise, and whether a listener received it. */
final class Rejection extends Special {
    private final Throwable error;
    private volatile boolean heard;

    Rejection(Throwable error) {
        this.error = error;
    }

    Throwable error() {
        return error;
    }

    void hear() {
        heard = true;
    }

    boolean isHeard() {
        return heard;
    }
}
