package io.troupe.actor;

import io.troupe.actor.promise.Owner;
import io.troupe.actor.time.Timer;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * One instance of an actor, from its start to its end or restart: on whose behalf listeners and timers run. On the
 * space's thread, but for {@link #isOver}.
 */
final class Life extends Owner {
    private static final int FEW = 8;

    private final ActorCell cell;
    private @Nullable List<Timer> timers; // most actors have none
    private int sweepAt = FEW;

    Life(ActorCell cell) {
        super(cell.space());
        this.cell = cell;
    }

    /** A timer that ends with this instance. Those that have run are swept out whenever their number has doubled. */
    void own(Timer timer) {
        if (timers == null) {
            timers = new ArrayList<>(1);
        } else if (timers.size() >= sweepAt) {
            timers.removeIf(each -> !each.isWaiting());
            sweepAt = Math.max(FEW, 2 * timers.size());
        }
        timers.add(timer);
    }

    @Override
    protected void end() {
        super.end();
        if (timers != null) {
            timers.forEach(Timer::cancel);
            timers = null;
        }
        cell.space().sequences().cancelThoseOf(this);
    }

    /** Rejects the requests that this instance has begun and not settled. */
    void rejectOpenRequests(String reason, @Nullable Throwable cause) {
        SpaceHome space = cell.space();
        for (var open : takeOpenRequests()) {
            var request = (Request<?>) open;
            var error = new ActorStoppedException(request + " was begun and not answered: " + reason, cause, true);
            if (request.reject(error) && space.isStopping()) {
                space.closing.noteOpenRequest(request);
            }
        }
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
