package io.troupe.actor.model;

import io.troupe.actor.model.ModelSpace.Task;
import java.util.ArrayDeque;
import org.jspecify.annotations.Nullable;

/** A callback of the model, both its sides. */
final class ModelStream {
    private final ModelSpace space;
    private final boolean cancellable;
    private final int most;
    private final String who;
    private final ModelRun.@Nullable Instance owner;
    private final Runnable onNext;
    private final ArrayDeque<Runnable> line = new ArrayDeque<>(); // if the number of results is limited
    private boolean usedFromOutside;
    int skipped;
    boolean ended;
    private boolean over;
    private boolean readerGone;

    /** @param most the number of results that may be queued; one more replaces the oldest */
    ModelStream(ModelSpace space, boolean cancellable, int most, String who, Runnable onNext) {
        this.space = space;
        this.cancellable = cancellable;
        this.most = most;
        this.who = who;
        this.owner = space.current;
        this.onNext = onNext;
    }

    boolean isCancelled() {
        return over || readerGone || owner != null && owner.over;
    }

    /** No more results are received from now on; the reader is notified of the end on its behalf. */
    void cancel() {
        if (cancellable && !over) {
            over = true;
            Runnable end = () -> space.history.add(who + " ends CancellationException");
            if (space.inside && (owner == null || owner == space.current)) {
                end.run();
            } else {
                space.enqueue(Task.callback(() -> deliver(end)));
            }
        }
    }

    void next(int value) {
        if (!isCancelled() && line.size() == most) {
            line.removeFirst();
            skipped++;
            line.add(() -> deliver(() -> hear(value))); // for the entry of an earlier one
        } else {
            send(() -> hear(value));
        }
    }

    private void hear(int value) {
        if (!over) {
            space.history.add(who + " hears =" + value);
            onNext.run();
        }
    }

    void finish() {
        ended = true;
        send(() -> end("well"));
    }

    void fail(String error) {
        ended = true;
        send(() -> {
            if (cancellable) {
                end(error);
            } else {
                space.history.add(who + " hears !" + error);
            }
        });
    }

    /** Ends the callback because no results will be sent. */
    void abandon(String error) {
        if (!ended) {
            fail(error);
        }
    }

    private void end(String how) {
        if (cancellable && !over) {
            over = true;
            space.history.add(who + " ends " + how);
        }
    }

    private void send(Runnable delivery) {
        if (isCancelled()) {
            return;
        }
        if (most == Integer.MAX_VALUE) {
            usedFromOutside |= !space.inside;
            Task task = Task.callback(() -> deliver(delivery));
            if (usedFromOutside) {
                space.enqueueBehindArrivals(task);
            } else {
                space.enqueue(task);
            }
        } else {
            // in the order in which they were sent, independent of the order of turns
            line.add(() -> deliver(delivery));
            space.enqueue(Task.callback(() -> line.removeFirst().run()));
        }
    }

    private void deliver(Runnable delivery) {
        if (owner == null) {
            space.guarded(delivery);
        } else if (owner.over) {
            readerGone = true;
        } else {
            owner.actor.guarded(owner, delivery);
        }
    }
}
