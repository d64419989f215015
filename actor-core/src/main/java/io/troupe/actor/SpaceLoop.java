package io.troupe.actor;

import io.troupe.actor.promise.Home;
import java.util.concurrent.locks.LockSupport;
import org.jspecify.annotations.Nullable;

/**
 * What the thread of a space does from the beginning to the end: pass after pass through the queues, or as many as
 * there is work for when it is cranked.
 */
final class SpaceLoop {
    private static final long SHORTEST_PAUSE_NANOS = 1_000_000;
    private static final long LONGEST_PAUSE_NANOS = 1_000_000_000;

    private final SpaceHome space;
    private final SpaceSettings settings;
    private final Dispatcher dispatcher;
    private final Lifeline lifeline;
    private final Rejections rejections;
    private final Closing closing;
    private boolean stopping;
    private long pauseNanos;

    SpaceLoop(
            SpaceHome space,
            SpaceSettings settings,
            Dispatcher dispatcher,
            Lifeline lifeline,
            Rejections rejections,
            Closing closing) {
        this.space = space;
        this.settings = settings;
        this.dispatcher = dispatcher;
        this.lifeline = lifeline;
        this.rejections = rejections;
        this.closing = closing;
    }

    /** What the thread does until the space is closed. */
    void live() {
        @Nullable Home before = null;
        @Nullable Runnable watch = null;
        try {
            before = space.enter();
            watch = watch();
            while (!stopping) {
                passAndSleep();
            }
        } finally {
            shut();
            if (watch != null) {
                watch.run();
            }
            SpaceHome.leave(before);
        }
    }

    /** Without a thread for the watchdog the space goes on unwatched. */
    private @Nullable Runnable watch() {
        try {
            return Watchdog.watch(space, settings, lifeline, dispatcher);
        } catch (Throwable noThread) {
            space.reports().error("the watchdog of space", space, noThread, null);
            return null;
        }
    }

    /**
     * Entries, handlers and listeners cannot throw as far as here. What can is the space's own bookkeeping when memory
     * is short; it has lost nothing by then, so it goes on, but not at full speed: memory may stay short for a while.
     */
    private void passAndSleep() {
        try {
            if (!dispatcher.pass() & !settle()) {
                lifeline.sleep(dispatcher, settings.clock());
            }
            pauseNanos = 0;
        } catch (Throwable broken) {
            if (pauseNanos == 0) { // else it is the same trouble still
                space.reports().error("the loop of space", space, broken, null);
            }
            pauseNanos = Math.min(LONGEST_PAUSE_NANOS, Math.max(SHORTEST_PAUSE_NANOS, 2 * pauseNanos));
            LockSupport.parkNanos(this, pauseNanos);
        }
    }

    /** See {@link ActorSpace#crank}. */
    void crank() {
        if (!settings.handCranked()) {
            throw new IllegalStateException(
                    "space " + space + " has a thread of its own and cannot be cranked by hand");
        }
        if (closing.isOver()) {
            return; // whoever still calls it is turned away at once
        }
        Thread serving = space.servingThread();
        if (serving != null) {
            throw new IllegalStateException("space " + space + " is being cranked already, by " + serving.getName());
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
            if (!closing.isOver()) { // after the end another thread may be acting for the space already
                space.giveUpThread();
            }
            SpaceHome.leave(before);
        }
    }

    /** Between two passes: lost rejections, then, if all is quiet, those who waited for that. */
    private boolean settle() {
        rejections.report();
        return stopping || !dispatcher.isQuiet() || dispatcher.runIdleActions();
    }

    /** Serves nothing more after the present turn. */
    void stop() {
        stopping = true;
        dispatcher.halt();
    }

    /** Whether it has served what it will ever serve. */
    boolean isStopping() {
        return stopping;
    }

    private void shut() {
        stop(); // also if an error has ended the thread
        closing.shut();
    }
}
