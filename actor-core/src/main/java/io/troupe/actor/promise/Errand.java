package io.troupe.actor.promise;

/** Something that another thread wants done to a promise on the thread of its home. */
final class Errand extends Node {
    private final Home home;
    private final Runnable action;

    Errand(Home home, Runnable action) {
        this.home = home;
        this.action = action;
    }

    @Override
    protected void run() {
        home.beginForItself();
        action.run();
    }
}
