package io.troupe.actor;

import io.troupe.actor.internal.loop.QueueEntry;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * A call with the context of its caller, in spaces that carry contexts, and with the handlers that have sent it: the
 * entry of the queues.
 */
final class CarriedCall extends QueueEntry {
    private final ActorCell cell;
    private final QueueEntry call;
    private final @Nullable Supplier<Runnable> context;
    private final int handlers; // see HandlerTurn

    CarriedCall(ActorCell cell, QueueEntry call, @Nullable Supplier<Runnable> context, int handlers) {
        this.cell = cell;
        this.call = call;
        this.context = context;
        this.handlers = handlers;
    }

    /** The call behind an entry. */
    static QueueEntry callIn(QueueEntry entry) {
        return entry instanceof CarriedCall carried ? carried.call : entry;
    }

    ActorCell cell() {
        return cell;
    }

    /** Runs a turn in the context, and as that of the handlers; throws nothing itself. */
    void run(Runnable turn) {
        if (handlers == 0) {
            runInContext(turn);
        } else {
            HandlerTurn.run(handlers, () -> runInContext(turn));
        }
    }

    private void runInContext(Runnable turn) {
        if (context == null) {
            turn.run();
            return;
        }
        Runnable end = context.get();
        try {
            turn.run();
        } finally {
            end.run();
        }
    }

    @Override
    protected @Nullable QueueEntry serve() {
        cell.deliverNext(this);
        return null;
    }

    @Override
    protected boolean isMessage() {
        return true;
    }

    @Override
    protected boolean carries(QueueEntry wanted) {
        return this == wanted || call == wanted;
    }
}
