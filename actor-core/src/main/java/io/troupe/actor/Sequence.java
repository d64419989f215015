package io.troupe.actor;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Owner;
import java.util.concurrent.Callable;
import java.util.concurrent.CancellationException;
import java.util.concurrent.locks.LockSupport;
import org.jspecify.annotations.Nullable;

/**
 * One body that may wait, and its thread; see {@link Sequences}. The baton is one volatile flag, which passes on all
 * that was written before.
 *
 * <p>{@link #go} and {@link #live} are called near the beginning of a stack, but {@link #giveBack} anywhere in a body,
 * also where the stack ends.
 */
final class Sequence<T extends @Nullable Object> {
    private final SpaceHome space;
    private final Owner owner;
    private final Callable<? extends T> body;
    private final Deferred<T> end;
    private volatile boolean given; // whether the body has the baton
    private @Nullable Thread giver;
    private @Nullable Thread thread;
    private boolean begun;
    private volatile boolean over;
    private @Nullable RuntimeException cancelled;

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
        return over;
    }

    /** Lets the body run until it ends or waits; on the space's thread. */
    void go() {
        if (over) {
            return;
        }
        giver = Thread.currentThread();
        given = true;
        if (begun) {
            LockSupport.unpark(thread);
        } else if (!begin()) {
            return;
        }
        boolean interrupted = false;
        while (given) {
            LockSupport.parkNanos(this, Lifeline.LONGEST_SLEEP_NANOS); // the body may be unable to wake it
            interrupted |= Thread.interrupted();
        }
        if (interrupted) {
            Thread.currentThread().interrupt();
        }
    }

    /** False if there is no thread for it, which is the body's error. */
    private boolean begin() {
        begun = true;
        try {
            HelperThreads.run(space + "-sequential", this::live);
            return true;
        } catch (Throwable noThread) {
            given = false;
            end.reject(noThread);
            return false;
        }
    }

    /** Lets the space's thread run until it lets the body go on; on the body's thread. */
    void giveBack() {
        Thread mine = Thread.currentThread();
        LockSupport.unpark(
                mine); // if the stack is too short for waiting, that shows here, while the body still has the baton
        LockSupport.park(this);
        space.handThreadTo(giver);
        given = false;
        try {
            LockSupport.unpark(giver);
        } catch (StackOverflowError endOfTheBodysStack) {
            // the giver looks by itself, and the body has to wait all the same
        }
        boolean interrupted = false;
        while (!given) {
            LockSupport.park(this);
            interrupted |= Thread.interrupted();
        }
        space.takeThread();
        if (interrupted) {
            mine.interrupt();
        }
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

    void live() {
        thread = Thread.currentThread();
        try {
            space.takeThread();
            space.runOnLoan(this::runBody);
        } catch (Throwable broken) {
            space.reports().error("a sequential body", space, broken, null);
        } finally {
            over = true;
            space.handThreadTo(giver); // this thread may run a body of another space before the giver wakes
            given = false;
            LockSupport.unpark(giver);
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
