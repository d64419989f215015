package io.troupe.actor;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Owner;
import io.troupe.actor.promise.Promise;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;
import java.util.concurrent.Callable;
import java.util.concurrent.CancellationException;
import org.jspecify.annotations.Nullable;

/**
 * The sequential bodies of a space, a form of coroutine. Each occupies one of the {@link HelperThreads}, but runs only
 * while it has control of the space: the space's thread passes control to it, and does nothing until control is
 * returned, so that only one of these threads runs at a time. On the thread that has control.
 */
final class SequentialBodies {
    private final SpaceHome space;
    private final Set<SequentialBody<?>> waiting = new LinkedHashSet<>();
    private @Nullable SequentialBody<?> running;

    SequentialBodies(SpaceHome space) {
        this.space = space;
    }

    <T extends @Nullable Object> Promise<T> start(Callable<? extends T> body, Owner owner) {
        var end = new Deferred<T>(space);
        var sequence = new SequentialBody<T>(space, owner, body, end);
        space.enqueueMessage(new Entry(() -> lend(sequence), () -> end.reject(closed())));
        return end;
    }

    /** Passes control to a body until it ends or waits. */
    private void lend(SequentialBody<?> sequence) {
        waiting.remove(sequence);
        running = sequence;
        space.beginTurnOf(sequence.owner());
        try {
            sequence.resume();
        } finally {
            running = null;
        }
    }

    /** Suspends the calling body until the promise is settled. */
    void await(Promise<?> promise) {
        SequentialBody<?> sequence = running;
        if (sequence == null) {
            throw new IllegalStateException(
                    "await() would stop the whole space, and with it whoever could settle " + promise
                            + ": register what comes next with then(..), return thenCompose(..), or call await() in the body of sequential(..)");
        }
        sequence.checkOwner();
        space.whenPromiseSettled(
                promise,
                sequence::hasEnded,
                () -> space.enqueueCallback(Entry.urgent(() -> resume(sequence), () -> resume(sequence))));
        while (!promise.isDone()) { // it may be resumed for a promise that it no longer waits for
            waiting.add(sequence);
            try {
                sequence.yieldControl();
            } finally {
                waiting.remove(sequence);
            }
            sequence.checkOwner();
        }
    }

    private void resume(SequentialBody<?> sequence) {
        if (waiting.contains(sequence)) {
            lend(sequence);
        } // else it was cancelled before
    }

    /** Resumes the bodies of an incarnation that has ended; their waits throw. */
    void cancelThoseOf(Incarnation life) {
        for (var sequence : List.copyOf(waiting)) {
            if (sequence.owner() == life) {
                space.enqueueCallback(Entry.urgent(() -> resume(sequence), () -> resume(sequence)));
            }
        }
    }

    /** The number of bodies that have begun and not ended, without the running one. */
    int count() {
        return waiting.size();
    }

    /** Called when the space is closed: cancels all waiting bodies. */
    void cancelAll() {
        for (var sequence : List.copyOf(waiting)) {
            sequence.cancel(closed());
            resume(sequence);
        }
    }

    private CancellationException closed() {
        return new CancellationException("space " + space + " was closed before this body had ended");
    }
}
