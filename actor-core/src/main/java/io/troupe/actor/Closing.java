package io.troupe.actor;

import io.troupe.actor.Reports.Trouble;
import io.troupe.actor.internal.Message;
import io.troupe.actor.internal.Recipient;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.QueueEntries;
import io.troupe.actor.internal.loop.QueueEntry;
import java.lang.invoke.MethodHandles;
import java.lang.invoke.VarHandle;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CancellationException;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;
import org.jspecify.annotations.Nullable;

/**
 * The shutdown of a space: requested by {@link #begin}, carried out by {@link #shut}, awaited with {@link #await}.
 * Afterwards, a thread that queues an entry must reject it itself.
 *
 * <p><b>Threads.</b> {@link #shut} on the space's thread, the rest on any thread.
 */
final class Closing {
    private static final int FRAMES_FOR_REJECTING = 128;
    private static final long LOOK_NANOS = 200_000_000;
    private static final VarHandle REJECTING;

    static {
        try {
            REJECTING = MethodHandles.lookup().findVarHandle(Closing.class, "rejecting", boolean.class);
        } catch (ReflectiveOperationException e) {
            throw new ExceptionInInitializerError(e);
        }
    }

    private final SpaceHome space;
    private final Dispatcher dispatcher;
    private final IdleStrategy idle;
    private final Reports.Rejections rejections;
    private final AtomicBoolean begun = new AtomicBoolean();
    private volatile boolean rejecting; // true while a thread rejects leftovers
    private final CountDownLatch ended = new CountDownLatch(1);
    private final Deferred<@Nullable Void> closed = Deferred.unbound();
    private final Drain last;
    private final List<Runnable> steps; // created in advance, so that closing needs little memory
    private int bodies;
    private volatile @Nullable Leftovers leftovers;
    private int openRequests;
    private final List<String> openExamples = new ArrayList<>();

    /**
     * Creates the shutdown of a running space.
     *
     * @param clockRegistration removes the space's registration with its clock
     */
    Closing(
            SpaceHome space,
            Dispatcher dispatcher,
            IdleStrategy idle,
            Reports.Rejections rejections,
            Runnable clockRegistration) {
        this.space = space;
        this.dispatcher = dispatcher;
        this.idle = idle;
        this.rejections = rejections;
        last = new Drain(space, dispatcher);
        steps = List.of(
                this::stopActors,
                this::stopBodies,
                space.itself()::endAttachment,
                clockRegistration,
                idle::close,
                this::dropWhatWaits,
                last::rejectAll,
                this::resolveClosed,
                last::rejectAll, // what the watchers have queued
                this::reportRejections,
                last::rejectAll, // what the error handler has sent to actors
                this::countLeftovers);
    }

    /** Queues the shutdown of the space behind everything queued now; only the first call has an effect. */
    void begin(Runnable stop) {
        if (begun.compareAndSet(false, true)) {
            space.enqueueMessage(new Entry(stop, stop));
        }
    }

    boolean hasBegun() {
        return begun.get();
    }

    boolean isOver() {
        return ended.getCount() == 0;
    }

    /** Fulfilled on the space's thread after its actors have stopped. */
    Promise<@Nullable Void> closed() {
        return closed;
    }

    /** Counts a request that had begun and was rejected because its actor was stopped; on the space's thread. */
    void noteOpenRequest(Request<?> request) {
        if (openRequests++ < Leftovers.EXAMPLES) {
            openExamples.add(request.name());
        }
    }

    int openRequests() {
        return openRequests;
    }

    List<String> openExamples() {
        return openExamples;
    }

    /** What was not done; available after the end. */
    Leftovers leftovers() {
        Leftovers counted = leftovers;
        return counted != null ? counted : last.leftovers(bodies); // there was no memory for it at the end
    }

    /** Carries out the shutdown. If one step throws, the others are still done, and the space is closed afterwards. */
    void shut() {
        rejecting = true; // no other thread rejects leftovers before this one has
        bodies = space.sequences().count();
        try {
            for (int step = 0; step < steps.size(); step++) { // no iterator: it would allocate
                try {
                    steps.get(step).run();
                } catch (Throwable broken) {
                    space.reports().error(Trouble.A_STEP_OF_THE_END, space, broken);
                }
            }
        } finally {
            idle.close();
            space.giveUpThread();
            space.dropContextClassLoader();
            rejecting = false;
            ended.countDown();
        }
        rejectLeftovers();
    }

    /** Stops the actors one by one, in the order of their start: a list would need memory. */
    private void stopActors() {
        var actors = space.actors();
        for (ActorCell first = actors.first(); first != null; first = actors.first()) {
            try {
                first.stop();
            } catch (Throwable broken) { // the others are stopped all the same
                space.reports().error(Trouble.STOPPED, first, broken);
            } finally {
                actors.remove(first);
            }
        }
    }

    /** Counts a task that was not run. */
    void rejectTask() {
        space.reports()
                .deadLetter(new DeadLetter(space.toString(), "a task", List.of(), "space " + space + " is closed"));
    }

    private void stopBodies() {
        space.sequences().cancelAll();
    }

    private void dropWhatWaits() {
        last.dropTimers(dispatcher.timers);
        last.dropIdleActions();
    }

    private void resolveClosed() {
        closed.resolve(null);
    }

    private void reportRejections() {
        rejections.releaseAll();
        rejections.report();
    }

    private void countLeftovers() {
        leftovers = last.leftovers(bodies);
    }

    /** Throws a StackOverflowError if the caller's stack is too short for {@link #rejectLeftovers}. */
    void checkStack() {
        descend(FRAMES_FOR_REJECTING, Home.current());
    }

    private static void descend(int frames, @Nullable Home current) {
        if (frames > 0) {
            descend(frames - 1, current);
        } else {
            // no effect: verifies that the call that must succeed at the end has room on the stack
            Home.leaveThread(current);
        }
    }

    /**
     * After the end: a caller that finds entries in the queues rejects them. One thread does so at a time, and acts for
     * the space meanwhile. A caller whose stack is too short throws before it begins, and leaves the entries to the
     * next caller.
     */
    void rejectLeftovers() {
        Home before = Home.current();
        while (dispatcher.hasArrivals()) {
            checkStack();
            if (!REJECTING.compareAndSet(this, false, true)) {
                return;
            }
            try {
                space.enter();
                new Drain(space, dispatcher).rejectAll();
                rejections.report();
            } finally {
                try {
                    space.giveUpThread();
                    Home.leaveThread(before);
                } finally {
                    // a plain store, not a call: it succeeds whatever was thrown, so the next caller can go on
                    rejecting = false;
                }
            }
        }
    }

    /**
     * Waits for the end.
     *
     * @return false if the space will not end, because its thread is in {@link System#exit}, which waits in turn for
     *     the shutdown hook that calls this
     */
    boolean await(Duration patience) {
        long left = Home.nanosOf(patience);
        try {
            while (!ended.await(Math.min(left, LOOK_NANOS), TimeUnit.NANOSECONDS)) {
                if (exits(space.servingThread())) {
                    return false;
                }
                left -= LOOK_NANOS;
                if (left <= 0) {
                    throw new ActorException("space " + space + " did not end within " + patience
                            + ": its thread is busy" + whatItDoes());
                }
            }
            return true;
        } catch (InterruptedException interrupted) {
            Thread.currentThread().interrupt();
            if (!isOver()) {
                throw new ActorException(
                        "interrupted while waiting for the end of space " + space + ": it ends when its thread is free",
                        interrupted);
            }
            return true;
        }
    }

    private static boolean exits(@Nullable Thread busy) {
        if (busy != null) {
            for (StackTraceElement frame : busy.getStackTrace()) {
                if (frame.getClassName().equals("java.lang.Runtime")
                        && frame.getMethodName().equals("exit")) {
                    return true;
                }
            }
        }
        return false;
    }

    private String whatItDoes() {
        Thread busy = space.servingThread();
        StackTraceElement[] stack = busy == null ? new StackTraceElement[0] : busy.getStackTrace();
        return stack.length == 0 ? "" : " at " + stack[0];
    }

    /** Rejects and counts what is left in the queues of a closed space. On the thread that acts for the space. */
    private static final class Drain {
        private static final int MOST_FOLLOWING = 1_000_000;

        private final SpaceHome space;
        private final Dispatcher dispatcher;
        private final List<String> examples = new ArrayList<>();
        private int messages;
        private int requests;
        private int tasks;
        private int timers;

        Drain(SpaceHome space, Dispatcher dispatcher) {
            this.space = space;
            this.dispatcher = dispatcher;
        }

        void dropTimers(TimerWheel wheel) {
            timers += space.timers().closeOutside();
            for (Runnable task : wheel.clear()) {
                timers++;
                if (task instanceof SpaceTimers.Expiry expiry) {
                    space.runGuarded(expiry.ifClosed());
                }
            }
        }

        void dropIdleActions() {
            for (int count = dispatcher.takeIdleActions().size(); count > 0; count--) {
                tasks++;
                space.closing.rejectTask();
            }
        }

        /**
         * Rejects entries until the queues are empty. Rejecting one may queue others, and handlers and listeners may go
         * on like that without end. So after {@value #MOST_FOLLOWING} that were queued meanwhile no further listener
         * runs and no handler is notified, and after as many again the rest stays behind.
         */
        void rejectAll() {
            long left = MOST_FOLLOWING + dispatcher.waiting();
            if (rejectUntilEmpty(left, false)) {
                return;
            }
            int handlers = HandlerTurn.now();
            HandlerTurn.set(HandlerTurn.ALL);
            try {
                rejectUntilEmpty(MOST_FOLLOWING + dispatcher.waiting(), true);
            } finally {
                HandlerTurn.set(handlers);
            }
            space.reports().error(Trouble.TURNING_AWAY, space, endless());
        }

        private static Throwable endless() {
            return new ActorException("what the handlers and listeners of a closed space queue comes to no end: after "
                    + MOST_FOLLOWING + " entries no further listener is run");
        }

        private boolean rejectUntilEmpty(long most, boolean cancelsListeners) {
            for (long left = most; left > 0; left--) {
                QueueEntry node = dispatcher.pollLeftover();
                if (node == null) {
                    return true;
                }
                try {
                    reject(node, cancelsListeners);
                } catch (Throwable broken) { // for example no memory: the entries behind it are still rejected
                    space.reports().error(Trouble.TURNING_AWAY, space, broken);
                }
            }
            return false;
        }

        private void reject(QueueEntry node, boolean cancelsListeners) {
            // no switch over types: linking it needs memory
            if (node instanceof Message ticket) {
                reject((ActorCell) ticket.receiver(), ticket);
            } else if (node instanceof Request<?> ticket) {
                reject((ActorCell) ticket.receiver(), ticket);
            } else if (node instanceof CarriedCall ticket) {
                reject(ticket.cell(), ticket);
            } else if (node instanceof Entry entry) {
                reject(entry);
            } else if (cancelsListeners && node instanceof Promise<?>) {
                QueueEntries.threw(node, new CancellationException("space " + space + " is closed"));
            } else {
                dispatcher.serveDirect(node);
            }
        }

        private void reject(ActorCell cell, QueueEntry ticket) {
            try {
                count(cell.callOf(ticket));
            } catch (Throwable noMemory) { // for an example
                space.reports().error(Trouble.TURNING_AWAY, space, noMemory);
            }
            space.beginForItself();
            cell.deliverNext(ticket); // which rejects it: the space has ended
        }

        private void count(QueueEntry call) {
            if (call instanceof Message message) {
                messages++;
                note(message, message.receiver());
            } else if (call instanceof Request<?> request && !request.isDone()) {
                requests++;
                note(request, request.receiver());
            }
        }

        private void reject(Entry entry) {
            Runnable ifClosed = entry.ifClosed();
            if (QueueEntries.isMessage(entry)) {
                tasks++;
            }
            if (ifClosed != null) {
                space.runGuarded(ifClosed);
            } else {
                space.closing.rejectTask();
            }
        }

        private void note(QueueEntry call, Recipient receiver) {
            if (examples.size() < Leftovers.EXAMPLES) {
                examples.add(call instanceof Request<?> request ? request.name() : call + " to " + receiver);
            }
        }

        private void note(String call) {
            if (examples.size() < Leftovers.EXAMPLES) {
                examples.add(call);
            }
        }

        Leftovers leftovers(int sequences) {
            space.closing.openExamples().forEach(this::note);
            return new Leftovers(messages, requests, space.closing.openRequests(), tasks, timers, sequences, examples);
        }
    }
}
