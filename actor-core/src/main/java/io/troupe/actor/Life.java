package io.troupe.actor;

import io.troupe.actor.promise.Owner;

/** One instance of an actor, from its start to its end or restart: on whose behalf listeners and timers run. On the space's thread. */
final class Life extends Owner {
    private final ActorCell cell;

    Life(ActorCell cell) {
        super(cell.space());
        this.cell = cell;
    }

    ActorCell cell() {
        return cell;
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

    boolean hasEnded() {
        return isOver();
    }

    @Override
    public String toString() {
        return cell.toString();
    }
}
