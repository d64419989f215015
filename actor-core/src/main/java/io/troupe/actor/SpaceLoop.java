package io.troupe.actor;

import io.troupe.actor.Reports.Trouble;
import io.troupe.actor.internal.loop.Home;
import java.util.concurrent.locks.LockSupport;
import org.jspecify.annotations.Nullable;

/**
 * The event loop of a space: pass after pass through the queues, with sleeps; or, when it has no thread, as many passes
 * as there is work for.
 */
final class SpaceLoop {
    private static final long SHORTEST_PAUSE_NANOS = 1_000_000;
    private static final long LONGEST_PAUSE_NANOS = 1_000_000_000;

    private final SpaceHome space;
    private final SpaceSettings settings;
    private final Dispatcher dispatcher;
    private final IdleStrategy idle;
    private final Reports.Rejections rejections;
    private final Closing closing;
    private boolean stopping;
    private long pauseNanos;

    SpaceLoop(
            SpaceHome space,
            SpaceSettings settings,
            Dispatcher dispatcher,
            IdleStrategy idle,
            Reports.Rejections rejections,
            Closing closing) {
        this.space = space;
        this.settings = settings;
        this.dispatcher = dispatcher;
        this.idle = idle;
        this.rejections = rejections;
        this.closing = closing;
    }

    /** The run method of the thread, until the space is closed. */
    void run() {
        @Nullable Home before = null;
        @Nullable Runnable watch = null;
        try {
            before = space.enter();
            watch = watch();
            while (!stopping) {
                passAndSleep();
            }
        } catch (Throwable broken) { // for example no memory for the first step
            space.reports().error(Trouble.THE_LOOP_WHICH_ENDS, space, broken);
        } finally {
            shut();
            endWatch(watch);
            Home.leaveThread(before);
        }
    }

    private void endWatch(@Nullable Runnable watch) {
        try {
            if (watch != null) {
                watch.run();
            }
        } catch (Throwable noMemory) { // it ends by itself
            space.reports().error(Trouble.THE_WATCHDOG, space, noMemory);
        }
    }

    /** Starts the watchdog; if there is no thread for it, the space runs without. */
    private @Nullable Runnable watch() {
        try {
            return Watchdog.watch(space, settings, idle, dispatcher);
        } catch (Throwable noThread) {
            space.reports().error(Trouble.THE_WATCHDOG, space, noThread);
            return null;
        }
    }

    /**
     * Runs one pass and sleeps if there was nothing to do. Entries, handlers and listeners cannot throw up to here.
     * Only the space's own code can, when memory is short. It has lost nothing then, so the loop continues, with pauses
     * because memory may stay short for a while.
     */
    private void passAndSleep() {
        try {
            if (dispatcher.pass() | settle()) {
                idle.letAccumulate(dispatcher.arrivals());
            } else {
                space.beginForItself(); // the actor of the last turn may be gone
                idle.sleep(dispatcher, settings.clock());
            }
            pauseNanos = 0;
        } catch (Throwable broken) {
            if (pauseNanos == 0) { // else it is the same problem
                space.reports().error(Trouble.THE_LOOP, space, broken);
            }
            pauseNanos = Math.min(LONGEST_PAUSE_NANOS, Math.max(SHORTEST_PAUSE_NANOS, 2 * pauseNanos));
            LockSupport.parkNanos(this, pauseNanos);
        }
    }

    /** See {@link ActorSpace#runQueued}. */
    void runQueued() {
        if (!settings.threadless()) {
            throw new IllegalStateException("space " + space + " has a thread, expected one without");
        }
        if (closing.isOver()) {
            return; // later callers are rejected immediately
        }
        Thread serving = space.servingThread();
        if (serving != null) {
            throw new IllegalStateException("space " + space + " is being run already, by " + serving.getName());
        }
        Home before = space.enter();
        try {
            boolean working = true;
            while (working && !stopping) {
                working = dispatcher.pass() | settle();
            }
            if (stopping) {
                shut();
            }
        } finally {
            if (!closing.isOver()) { // after the end another thread may already be acting for the space
                space.giveUpThread();
            }
            Home.leaveThread(before);
        }
    }

    /** Between two passes: reports unhandled rejections, then runs the idle actions if the space is idle. */
    private boolean settle() {
        rejections.report();
        return stopping || !dispatcher.isQuiet() || dispatcher.runIdleActions();
    }

    /** Processes nothing more after the current turn. */
    void stop() {
        stopping = true;
        dispatcher.halt();
    }

    /** True once the space processes no further entries. */
    boolean isStopping() {
        return stopping;
    }

    private void shut() {
        stop(); // also if an error has ended the thread
        closing.shut();
    }
}
