package io.troupe.actor;

/** One instance of an actor, from its start to its end or restart: on whose behalf listeners and timers run. On the space's thread, but for {@link #isOver}. */
final class Life {
    private final ActorCell cell;
    private volatile boolean over; // written by the space's thread only

    Life(ActorCell cell) {
        this.cell = cell;
    }

    void end() {
        over = true;
    }

    /** Whether it has ended; any thread. */
    boolean isOver() {
        return over;
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
