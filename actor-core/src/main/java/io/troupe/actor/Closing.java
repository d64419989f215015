package io.troupe.actor;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Home;
import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Objects;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;
import org.jspecify.annotations.Nullable;

/**
 * The end of a space: asked for by {@link #begin}, carried out by {@link #shut}, waited for with {@link #await}; after that, whoever still queues something
 * turns it away himself.
 *
 * <p><b>Threads.</b> {@link #shut} on the space's thread, the rest on any.
 */
final class Closing {
    private final SpaceHome space;
    private final Dispatcher dispatcher;
    private final Lifeline lifeline;
    private final Rejections rejections;
    private final Runnable clockRegistration;
    private final AtomicBoolean begun = new AtomicBoolean();
    private final AtomicBoolean refusing = new AtomicBoolean();
    private final CountDownLatch ended = new CountDownLatch(1);
    private final Deferred<@Nullable Void> closed = new Deferred<>((Home) null);
    private volatile @Nullable Leftovers leftovers;
    private final List<String> openRequests = new ArrayList<>();

    /**
     * The end of a space that lives.
     *
     * @param clockRegistration runs when the clock need not wake the space any more
     */
    Closing(
            SpaceHome space,
            Dispatcher dispatcher,
            Lifeline lifeline,
            Rejections rejections,
            Runnable clockRegistration) {
        this.space = space;
        this.dispatcher = dispatcher;
        this.lifeline = lifeline;
        this.rejections = rejections;
        this.clockRegistration = clockRegistration;
    }

    /** Stops the space behind what is queued now; only the first call does. */
    void begin(Runnable stop) {
        if (begun.compareAndSet(false, true)) {
            space.enqueueMail(new Entry(stop, stop));
        }
    }

    boolean hasBegun() {
        return begun.get();
    }

    boolean isOver() {
        return ended.getCount() == 0;
    }

    /** Fulfilled, on the space's thread, after its actors have stopped. */
    Promise<@Nullable Void> closed() {
        return closed;
    }

    /** A request had begun and was rejected when its actor was stopped; on the space's thread. */
    void noteOpenRequest(Request<?> request) {
        openRequests.add(request.toString());
    }

    List<String> openRequests() {
        return openRequests;
    }

    /** What was not done; when it is over. */
    Leftovers leftovers() {
        return Objects.requireNonNull(leftovers);
    }

    void shut() {
        var last = new Refusal(space, dispatcher);
        refusing.set(true); // nobody else turns leftovers away before this thread has
        int bodies = space.sequences().count();
        try {
            space.actors().all().forEach(ActorCell::stop);
            space.sequences().cancelAll();
            clockRegistration.run();
            lifeline.close();
            last.dropTimers(dispatcher.timers);
            last.dropIdleActions();
            last.refuseAll();
            closed.resolve(null);
            last.refuseAll(); // what those who watched have queued
            rejections.releaseAll();
            rejections.report();
            last.refuseAll(); // what the error handler has asked of actors
        } finally {
            leftovers = last.leftovers(bodies);
            lifeline.close();
            space.giveUpThread();
            refusing.set(false);
            ended.countDown();
        }
        refuseLeftovers();
    }

    /** After the end: whoever finds entries in the queues turns them away; one at a time, and meanwhile it acts for the space. */
    void refuseLeftovers() {
        while (!dispatcher.inbox.isEmpty() && refusing.compareAndSet(false, true)) {
            Home before = space.enter();
            try {
                new Refusal(space, dispatcher).refuseAll();
                rejections.report();
            } finally {
                space.giveUpThread();
                SpaceHome.leave(before);
                refusing.set(false);
            }
        }
    }

    void await(Duration patience) {
        try {
            if (!ended.await(SpaceHome.countedNanos(patience), TimeUnit.NANOSECONDS)) {
                throw new ActorException(
                        "space " + space + " did not end within " + patience + ": its thread is busy" + whatItDoes());
            }
        } catch (InterruptedException interrupted) {
            Thread.currentThread().interrupt();
            if (!isOver()) {
                throw new ActorException(
                        "interrupted while waiting for the end of space " + space + ": it ends when its thread is free",
                        interrupted);
            }
        }
    }

    private String whatItDoes() {
        Thread busy = space.servingThread();
        StackTraceElement[] stack = busy == null ? new StackTraceElement[0] : busy.getStackTrace();
        return stack.length == 0 ? "" : " at " + stack[0];
    }
}
