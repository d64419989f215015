package io.troupe.actor;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Owner;
import java.util.concurrent.Callable;
import java.util.concurrent.CancellationException;
import java.util.concurrent.Semaphore;
import org.jspecify.annotations.Nullable;

/** One body that may wait, and its virtual thread; see {@link Sequences}. The semaphores pass the baton, and with it all that was written. */
final class Sequence<T extends @Nullable Object> {
    private final SpaceHome space;
    private final Owner owner;
    private final Callable<? extends T> body;
    private final Deferred<T> end;
    private final Semaphore given = new Semaphore(0);
    private final Semaphore givenBack = new Semaphore(0);
    private @Nullable Thread thread;
    private @Nullable RuntimeException cancelled;
    private volatile boolean ended;

    Sequence(SpaceHome space, Owner owner, Callable<? extends T> body, Deferred<T> end) {
        this.space = space;
        this.owner = owner;
        this.body = body;
        this.end = end;
    }

    Owner owner() {
        return owner;
    }

    /** Whether the body has returned or thrown; any thread. */
    boolean hasEnded() {
        return ended;
    }

    /** The thread it runs on; not started before the first time. */
    Thread thread() {
        if (thread == null) {
            thread = Thread.ofVirtual().name(space + "-sequential").unstarted(this::live);
        }
        return thread;
    }

    /** Lets the body run until it ends or waits; on the space's thread. */
    void go() {
        if (thread().getState() == Thread.State.NEW) {
            thread().start();
        } else {
            given.release();
        }
        givenBack.acquireUninterruptibly();
    }

    /** Lets the space's thread run until it lets the body go on; on the body's thread. */
    void giveBack() {
        givenBack.release();
        given.acquireUninterruptibly();
    }

    /** The next wait, or the one that it is in, ends with this exception. */
    void cancel(RuntimeException reason) {
        cancelled = reason;
    }

    void checkOwner() {
        if (cancelled != null) {
            throw cancelled;
        }
        if (owner instanceof Life life && life.isOver()) {
            throw new CancellationException("the actor " + life + " has stopped while a body of it waited");
        }
    }

    private void live() {
        try {
            space.runOnLoan(this::runBody);
        } finally {
            ended = true;
            givenBack.release();
        }
    }

    private void runBody() {
        if (end.isDone()) {
            return; // cancelled before it began
        }
        try {
            checkOwner();
            end.resolve(body.call());
        } catch (Throwable thrown) {
            end.reject(thrown);
        }
    }
}
