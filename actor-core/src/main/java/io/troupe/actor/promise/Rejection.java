package io.troupe.actor.promise;

/** The error of a rejected promise, and whether a listener received it. */
final class Rejection extends SettledState {
    private final Throwable error;
    private volatile boolean handled;

    Rejection(Throwable error) {
        this.error = error;
    }

    Throwable error() {
        return error;
    }

    void markHandled() {
        handled = true;
    }

    boolean isHandled() {
        return handled;
    }
}
