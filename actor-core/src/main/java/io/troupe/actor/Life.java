package io.troupe.actor;

import io.troupe.actor.promise.Owner;

/** One instance of an actor, from its start to its end or restart: on whose behalf listeners and timers run. On the space's thread, but for {@link #isOver}. */
final class Life extends Owner {
    private final ActorCell cell;

    Life(ActorCell cell) {
        super(cell.space());
        this.cell = cell;
    }

    @Override
    protected void end() {
        super.end();
        cell.space().sequences().cancelThoseOf(this);
    }

    /** Runs something on behalf of this instance; false if it has ended. */
    boolean run(String what, Runnable action) {
        if (isOver()) {
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
