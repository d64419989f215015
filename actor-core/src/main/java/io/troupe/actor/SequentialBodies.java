package io.troupe.actor;

import io.troupe.actor.Reports.Trouble;
import io.troupe.actor.internal.loop.TurnOwner;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;
import java.util.concurrent.Callable;
import java.util.concurrent.CancellationException;
import java.util.concurrent.locks.LockSupport;
import org.jspecify.annotations.Nullable;

/**
 * The sequential bodies of a space, a form of coroutine. Each occupies one of the {@link BlockingTaskThreads}, but runs
 * only while it has control of the space: the space's thread passes control to it, and does nothing until control is
 * returned, so that only one of these threads runs at a time. On the thread that has control.
 */
final class SequentialBodies {
    private final SpaceHome space;
    private final Set<Body<?>> waiting = new LinkedHashSet<>();
    private @Nullable Body<?> running;

    SequentialBodies(SpaceHome space) {
        this.space = space;
    }

    <T extends @Nullable Object> Promise<T> start(Callable<? extends T> body, TurnOwner owner) {
        var end = new Deferred<T>(space, null);
        var sequence = new Body<T>(space, owner, body, end);
        sequence.limit = space.isCurrent() ? space.limit() : null;
        sequence.served = space.isCurrent() ? space.served() : null;
        space.enqueueMessage(new Entry(() -> lend(sequence), () -> end.reject(closed())));
        return end;
    }

    /** Passes control to a body until it ends or waits. */
    private void lend(Body<?> sequence) {
        waiting.remove(sequence);
        running = sequence;
        space.begin(sequence.owner());
        TimeLimit before = space.limit();
        space.setLimit(sequence.limit);
        var servedBefore = space.serve(sequence.served);
        try {
            sequence.resume();
        } finally {
            running = null;
            space.serve(servedBefore);
            space.setLimit(before);
        }
    }

    /** Suspends the calling body until the promise is settled. */
    void await(Promise<?> promise) {
        Body<?> sequence = running;
        if (sequence == null) {
            throw new IllegalStateException(
                    "await() would stop the whole space, and with it the code that could settle " + promise
                            + ": register what comes next with then(..), return thenCompose(..), or call await() in the body of sequential(..); in a Kotlin coroutine: coAwait()");
        }
        sequence.checkOwner();
        Promise.whenSettled(
                promise,
                sequence::hasEnded,
                () -> space.enqueue(Entry.urgent(() -> resume(sequence), () -> resume(sequence))));
        sequence.limit = space.limit();
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

    private void resume(Body<?> sequence) {
        if (waiting.contains(sequence)) {
            lend(sequence);
        } // else it was cancelled before
    }

    /** Resumes the bodies of an incarnation that has ended; their waits throw. */
    void cancelThoseOf(Incarnation life) {
        for (var sequence : List.copyOf(waiting)) {
            if (sequence.owner() == life) {
                space.enqueue(Entry.urgent(() -> resume(sequence), () -> resume(sequence)));
            }
        }
    }

    /** The number of bodies that have begun and not ended, without the running one. */
    int count() {
        return waiting.size();
    }

    /** Called when the space is closed: cancels all waiting bodies. */
    void cancelAll() {
        while (!waiting.isEmpty()) { // one by one: a copy would need memory
            Body<?> sequence = waiting.iterator().next();
            try {
                sequence.cancel(closed());
                resume(sequence);
            } finally {
                waiting.remove(sequence);
            }
        }
    }

    private CancellationException closed() {
        return new CancellationException("space " + space + " was closed before this body had ended");
    }

    /**
     * One sequential body and its thread; see {@link SequentialBodies}. Control passes between the space's thread and
     * the body's thread by one volatile flag, which also publishes all earlier writes.
     *
     * <p>{@link #resume} and {@link #run} are called near the bottom of a stack, but {@link #yieldControl} anywhere in
     * a body, even where its stack is nearly exhausted.
     */
    static final class Body<T extends @Nullable Object> {
        private final SpaceHome space;
        private final TurnOwner owner;
        private final Callable<? extends T> body;
        private final Deferred<T> end;
        private volatile boolean hasControl; // true while the body has control
        private @Nullable TimeLimit limit; // while it waits; accessed by the thread that has control
        private ObservedCalls.@Nullable ObservedCall served;
        private @Nullable Thread spaceThread;
        private @Nullable Thread thread;
        private boolean begun;
        private volatile boolean over;
        private @Nullable RuntimeException cancelled;

        Body(SpaceHome space, TurnOwner owner, Callable<? extends T> body, Deferred<T> end) {
            this.space = space;
            this.owner = owner;
            this.body = body;
            this.end = end;
        }

        TurnOwner owner() {
            return owner;
        }

        /** True if the body has returned or thrown; any thread. */
        boolean hasEnded() {
            return over;
        }

        /** Lets the body run until it ends or waits; on the space's thread. */
        void resume() {
            if (over) {
                return;
            }
            spaceThread = Thread.currentThread();
            hasControl = true;
            if (begun) {
                LockSupport.unpark(thread);
            } else if (!begin()) {
                return;
            }
            boolean interrupted = false;
            while (hasControl) {
                // limited, because the body may be unable to wake it
                LockSupport.parkNanos(this, IdleStrategy.LONGEST_SLEEP_NANOS);
                interrupted |= Thread.interrupted();
            }
            if (interrupted) {
                Thread.currentThread().interrupt();
            }
        }

        /** Starts the body; false if there is no thread for it, which rejects the body's promise. */
        private boolean begin() {
            begun = true;
            try {
                BlockingTaskThreads.run(space + "-sequential", space.contextClassLoader(), this::run);
                return true;
            } catch (Throwable noThread) {
                hasControl = false;
                end.reject(noThread);
                return false;
            }
        }

        /** Passes control to the space's thread until it lets the body continue; on the body's thread. */
        void yieldControl() {
            Thread mine = Thread.currentThread();
            LockSupport.unpark(
                    mine); // if the stack is too short for waiting, this throws while the body still has control
            LockSupport.park(this);
            space.handThreadTo(spaceThread);
            hasControl = false;
            try {
                LockSupport.unpark(spaceThread);
            } catch (StackOverflowError endOfTheBodysStack) {
                // the other thread checks the flag by itself, and the body must wait in any case
            }
            boolean interrupted = false;
            while (!hasControl) {
                LockSupport.park(this);
                interrupted |= Thread.interrupted();
            }
            space.takeThread();
            if (interrupted) {
                mine.interrupt();
            }
        }

        /** Makes the current or the next wait end with this exception. */
        void cancel(RuntimeException reason) {
            cancelled = reason;
        }

        void checkOwner() {
            if (cancelled != null) {
                throw cancelled;
            }
            if (owner instanceof Incarnation life && life.isOver()) {
                throw new CancellationException("the actor " + life + " has stopped while a body of it waited");
            }
        }

        void run() {
            thread = Thread.currentThread();
            try {
                space.takeThread();
                space.runOnLoan(this::runBody);
            } catch (Throwable broken) {
                space.reports().error(Trouble.A_SEQUENTIAL_BODY, space, broken);
            } finally {
                over = true;
                // this thread may run a body of another space before the other thread wakes up
                space.handThreadTo(spaceThread);
                hasControl = false;
                LockSupport.unpark(spaceThread);
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
}
