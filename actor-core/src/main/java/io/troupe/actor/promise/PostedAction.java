package io.troupe.actor.promise;

/** An operation on a local promise, posted by another thread to the promise's home. */
final class PostedAction extends Node {
    private final Home home;
    private final Runnable action;

    PostedAction(Home home, Runnable action) {
        this.home = home;
        this.action = action;
    }

    @Override
    protected void run() {
        home.beginForItself();
        action.run();
    }
}
