package io.troupe.actor;

/** One instance of an actor, from its start to its end or restart: on whose behalf listeners and timers run. On the space's thread. */
final class Life {
    private final ActorCell cell;
    private boolean over;

    Life(ActorCell cell) {
        this.cell = cell;
    }

    void end() {
        over = true;
    }

    /** Runs something on behalf of this instance; false if it has ended. */
    boolean run(String what, Runnable action) {
        if (over) {
            return false;
        }
        cell.guard(what, action);
        return true;
    }

    @Override
    public String toString() {
        return cell.toString();
    }
}
