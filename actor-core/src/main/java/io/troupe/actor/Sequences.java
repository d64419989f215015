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
 * The bodies of a space that are written as if they could wait. Each has one of the {@link HelperThreads} to itself,
 * but runs only while it holds the space's baton: the space's thread hands it over and does nothing until it comes
 * back, so that never more than one of them runs. On the thread that holds the baton.
 */
final class Sequences {
    private final SpaceHome space;
    private final Set<Sequence<?>> waiting = new LinkedHashSet<>();
    private @Nullable Sequence<?> running;

    Sequences(SpaceHome space) {
        this.space = space;
    }

    <T extends @Nullable Object> Promise<T> start(Callable<? extends T> body, Owner owner) {
        var end = new Deferred<T>(space);
        var sequence = new Sequence<T>(space, owner, body, end);
        space.enqueueMail(new Entry(() -> lend(sequence), () -> end.reject(closed())));
        return end;
    }

    /** Gives the baton to a body until it ends or waits for something. */
    private void lend(Sequence<?> sequence) {
        waiting.remove(sequence);
        running = sequence;
        space.beginTurnOf(sequence.owner());
        try {
            sequence.go();
        } finally {
            running = null;
        }
    }

    /** The body that is calling waits until the promise is settled. */
    void await(Promise<?> promise) {
        Sequence<?> sequence = running;
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
        while (!promise.isDone()) { // it may be resumed for one that it does not wait for any more
            waiting.add(sequence);
            try {
                sequence.giveBack();
            } finally {
                waiting.remove(sequence);
            }
            sequence.checkOwner();
        }
    }

    private void resume(Sequence<?> sequence) {
        if (waiting.contains(sequence)) {
            lend(sequence);
        } // else it was cancelled before
    }

    /** The bodies of one instance of an actor that is over do not wait any longer. */
    void cancelThoseOf(Life life) {
        for (var sequence : List.copyOf(waiting)) {
            if (sequence.owner() == life) {
                space.enqueueCallback(Entry.urgent(() -> resume(sequence), () -> resume(sequence)));
            }
        }
    }

    /** How many have begun and not ended, the running one left out. */
    int count() {
        return waiting.size();
    }

    /** The space is closed: nobody waits any longer. */
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
