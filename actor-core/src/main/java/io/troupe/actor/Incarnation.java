package io.troupe.actor;

import io.troupe.actor.Reports.Trouble;
import io.troupe.actor.internal.loop.QueueEntry;
import io.troupe.actor.internal.loop.TurnOwner;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * One incarnation of an actor, from its start to its stop or restart: the owner of its listeners and timers. On the
 * space's thread, except for {@link #isOver}.
 */
final class Incarnation extends TurnOwner {
    private static final int FEW = 8;

    private final ActorCell cell;
    private @Nullable OwnTimers timers; // most actors have none

    Incarnation(ActorCell cell) {
        super(cell.space());
        this.cell = cell;
    }

    ActorCell cell() {
        return cell;
    }

    /** Adds a timer that ends with this incarnation. */
    void own(Timer timer) {
        if (timers == null) {
            timers = new OwnTimers();
        }
        timers.add(timer);
    }

    /** Ends everything of this incarnation, whatever a part of it throws. */
    void endAll(boolean restarted, @Nullable Throwable cause) {
        end();
        SpaceHome space = cell.space();
        try {
            if (timers != null) {
                timers.cancelAll();
                timers = null;
            }
            space.sequences().cancelThoseOf(this);
        } catch (Throwable noMemory) {
            space.reports().error(Trouble.STOPPED, cell, noMemory);
        }
        // one by one: a list would need memory, which may be what the actor has used up
        for (QueueEntry open = takeOpenRequest(); open != null; open = takeOpenRequest()) {
            rejectOpen((Request<?>) open, restarted, cause);
        }
        try {
            endAttachment();
        } catch (Throwable broken) { // a coroutine that was cancelled
            space.reports().error(Trouble.STOPPED, cell, broken);
        }
    }

    /** Rejects a request that this incarnation has begun and not answered; throws nothing. */
    private void rejectOpen(Request<?> request, boolean restarted, @Nullable Throwable cause) {
        SpaceHome space = cell.space();
        Throwable error = cell.stoppedError(request, restarted, cause);
        boolean wasOpen = space.reports().reject(request, error);
        try {
            if (wasOpen && space.isStopping()) {
                space.closing.noteOpenRequest(request);
            }
            if (request instanceof SuspendingRequest<?> suspended) {
                suspended.cancelCoroutine();
            }
        } catch (Throwable broken) {
            space.reports().error(Trouble.STOPPED, cell, broken);
        }
        space.reports().logArguments(request, ActorCell.NOT_ANSWERED);
    }

    /** A failure of a coroutine of this actor is a failure of the actor. */
    @Override
    public void failed(String what, Throwable error) {
        if (isOver()) {
            super.failed(what, error); // the next incarnation is not to blame
        } else {
            cell.failed(what, error);
        }
    }

    @Override
    public boolean listenerFailed(Throwable error) {
        if (isOver() || !cell.countsRequests(error)) {
            return false;
        }
        cell.failed("a listener", error);
        return true;
    }

    @Override
    public boolean run(String what, Runnable action) {
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

    /** Timers that have run are removed whenever the number of timers has doubled. */
    private static final class OwnTimers {
        private final List<Timer> waiting = new ArrayList<>(1);
        private int sweepAt = FEW;

        void add(Timer timer) {
            if (waiting.size() >= sweepAt) {
                waiting.removeIf(each -> !each.isWaiting());
                sweepAt = Math.max(FEW, 2 * waiting.size());
            }
            waiting.add(timer);
        }

        void cancelAll() {
            for (int index = 0; index < waiting.size(); index++) {
                waiting.get(index).cancel();
            }
        }
    }
}
