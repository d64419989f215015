package io.troupe.actor;

import io.troupe.actor.RecorderEvents.SpaceFiguresEvent;
import io.troupe.actor.RecorderEvents.StallEvent;
import io.troupe.actor.internal.loop.Home;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.locks.LockSupport;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * Detects stalled spaces from a separate thread. It costs the space one plain store for each entry.
 *
 * <p><b>Threads.</b> One platform thread checks all watched spaces; it starts with the first and ends soon after the
 * last. What takes time, the stall listener and the flight recorder, runs on one of the {@link BlockingTaskThreads}.
 */
final class Watchdog {
    private static final int LOOKS_PER_LIMIT = 4;

    private static final System.Logger LOG = System.getLogger(Watchdog.class.getName());
    private static final Looks LOOKS = new Looks();
    private static final boolean CAN_RECORD = loadEvents();

    private final SpaceHome space;
    private final IdleStrategy idle;
    private final Dispatcher dispatcher;
    private final long limitNanos;
    private final Consumer<Stall> listener;
    private final Clock clock = Clock.system();
    private long seen = -1;
    private long since = clock.nanos();
    private boolean reported;
    private boolean failed;
    private volatile boolean recording = CAN_RECORD;
    private volatile boolean over;
    private final long periodNanos;
    private long nextLookNanos; // on the thread of the looks
    private volatile @Nullable Watchdog next; // in the list of the looks

    private Watchdog(
            SpaceHome space, IdleStrategy idle, Dispatcher dispatcher, Duration limit, Consumer<Stall> listener) {
        this.space = space;
        this.idle = idle;
        this.dispatcher = dispatcher;
        this.limitNanos = Home.nanosOf(limit);
        this.periodNanos = Math.max(1, limitNanos / LOOKS_PER_LIMIT);
        this.nextLookNanos = since + periodNanos;
        this.listener = listener;
    }

    /** Loads the event classes before the first check, not when memory is short. */
    private static boolean loadEvents() {
        try {
            new SpaceFiguresEvent();
            new StallEvent(new Stall("", Duration.ZERO, List.of()));
            return true;
        } catch (Throwable broken) {
            LOG.log(System.Logger.Level.ERROR, "the flight recorder gets no figures and no stalls", broken);
            return false;
        }
    }

    /**
     * Watches a space.
     *
     * @return ends the watch; null if the space is not to be watched
     */
    static @Nullable Runnable watch(SpaceHome space, SpaceSettings settings, IdleStrategy idle, Dispatcher dispatcher) {
        Duration limit = settings.stallLimit();
        if (limit == null) {
            return null;
        }
        var watchdog = new Watchdog(space, idle, dispatcher, limit, settings.onStall());
        LOOKS.add(watchdog);
        return () -> LOOKS.end(watchdog);
    }

    /**
     * Looks at all watched spaces, on one thread, which starts with the first of them and ends {@value #IDLE_SECONDS}
     * seconds after the last. Not an executor of the JDK: a full heap could end its thread, or lose a periodic task.
     * Here nothing allocates between two looks.
     */
    private static final class Looks implements Runnable {
        private static final long IDLE_SECONDS = 10;
        private static final long IDLE_NANOS = IDLE_SECONDS * 1_000_000_000;
        private static final long AFTER_ERROR_NANOS = 100_000_000;

        private final Clock clock = Clock.system();
        private volatile @Nullable Watchdog first; // written under this
        private @Nullable Thread thread; // guarded by this

        synchronized void add(Watchdog watchdog) {
            Thread own = thread;
            if (own == null) {
                own = CleanThreads.create(() -> Thread.ofPlatform()
                        .daemon()
                        .inheritInheritableThreadLocals(false)
                        .name("troupe-watchdog")
                        .unstarted(this));
                own.start(); // if there is no thread, nothing is watched
                thread = own;
            }
            watchdog.next = first;
            first = watchdog;
            LockSupport.unpark(own); // its next look may be the first one
        }

        /** Ends a watch, which keeps nothing of its space. */
        synchronized void end(Watchdog watchdog) {
            watchdog.over = true;
            Watchdog before = null;
            for (Watchdog each = first; each != null; each = each.next) {
                if (each == watchdog && before == null) {
                    first = each.next;
                } else if (each == watchdog) {
                    before.next = each.next; // its own link stays, for a look that has come to it
                } else {
                    before = each;
                }
            }
        }

        @Override
        public void run() {
            long idleSince = clock.nanos();
            while (true) {
                try {
                    long now = clock.nanos();
                    long pause = lookAtAll(now);
                    idleSince = first != null ? now : idleSince;
                    if (now - idleSince >= IDLE_NANOS && hasEnded()) {
                        return;
                    }
                    LockSupport.parkNanos(this, pause);
                } catch (Throwable broken) { // of the JDK's own code: nothing here throws
                    LockSupport.parkNanos(this, AFTER_ERROR_NANOS);
                }
            }
        }

        /** Looks at those whose turn it is; returns the time until the next one. */
        private long lookAtAll(long now) {
            long pause = IDLE_NANOS;
            for (Watchdog each = first; each != null; each = each.next) {
                if (each.nextLookNanos - now <= 0) {
                    each.look();
                    each.nextLookNanos = clock.nanos() + each.periodNanos;
                }
                pause = Math.min(pause, each.nextLookNanos - now);
            }
            return pause;
        }

        private synchronized boolean hasEnded() {
            if (first == null) {
                thread = null;
            }
            return first == null;
        }
    }

    /** Checks the space; throws nothing, because other spaces are watched by the same thread. */
    private void look() {
        if (over) {
            return;
        }
        try {
            long served = dispatcher.served();
            long now = clock.nanos();
            if (served != seen || idle.isAsleep()) {
                seen = served;
                since = now;
                reported = false;
            } else if (!reported && now - since >= limitNanos) {
                report(served, now - since);
            }
            failed = false;
        } catch (Throwable broken) { // for example no memory: the next check may succeed
            if (!failed) {
                failed = true;
                log(Words.FAILED, broken);
            }
        }
        if (recording) {
            startRecording();
        }
    }

    /** What is logged, as objects that exist when memory is short; the name of the space stands between the words. */
    private enum Words {
        FAILED("the watchdog of space ", " failed"),
        LISTENER_FAILED("the stall listener of space ", " threw"),
        NOT_RECORDED("space ", " records no more figures and stalls");

        private final String before;
        private final String behind;

        Words(String before, String behind) {
            this.before = before;
            this.behind = behind;
        }
    }

    private void log(Words words, Throwable broken) {
        try {
            LOG.log(System.Logger.Level.ERROR, words.before + space + words.behind, broken);
        } catch (Throwable again) {
            // the log fails too, or there is no memory
        }
    }

    private void report(long served, long nanos) {
        Thread busy = space.servingThread();
        if (busy == null) {
            return;
        }
        var stack = List.of(busy.getStackTrace());
        if (served != dispatcher.served() || idle.isAsleep() || !isInATurn(stack)) {
            return; // the space was about to continue, or it waits for a processor, which is not a stall
        }
        var stall = new Stall(space.toString(), Duration.ofNanos(nanos), stack);
        // on another thread, because the listener may block and other spaces are watched too
        BlockingTaskThreads.run(space + "-stall", space.contextClassLoader(), () -> notifyListener(stall));
        reported = true; // once per message
    }

    private void notifyListener(Stall stall) {
        if (recording) {
            try {
                new StallEvent(stall).commit();
            } catch (Throwable broken) {
                recorderFailed(broken);
            }
        }
        try {
            listener.accept(stall);
        } catch (Throwable broken) {
            log(Words.LISTENER_FAILED, broken);
        }
    }

    /** True if the stack is that of an entry or a handler, not of the space's own loop or of its sleep. */
    static boolean isInATurn(List<StackTraceElement> stack) {
        return stack.stream().anyMatch(Watchdog::isATurn);
    }

    private static boolean isATurn(StackTraceElement frame) {
        String type = frame.getClassName();
        return type.equals(Dispatcher.class.getName())
                        && (frame.getMethodName().equals("serveOne")
                                || frame.getMethodName().equals("runTask"))
                || type.equals(SequentialBodies.Body.class.getName())
                || type.equals(Reports.class.getName());
    }

    /** Records the metrics if the flight recorder is on. */
    private void startRecording() {
        try {
            if (new SpaceFiguresEvent().isEnabled()) {
                BlockingTaskThreads.run(space + "-figures", space.contextClassLoader(), this::recordFigures);
            }
        } catch (Throwable broken) {
            recorderFailed(broken);
        }
    }

    private void recordFigures() {
        try {
            var event = new SpaceFiguresEvent();
            event.fill(space);
            event.commit();
        } catch (Throwable broken) {
            recorderFailed(broken);
        }
    }

    /**
     * The watch does not depend on the recorder: after an error nothing more is recorded for this space, unless only
     * the memory was short.
     */
    private void recorderFailed(Throwable broken) {
        if (!(broken instanceof OutOfMemoryError)) {
            recording = false;
            log(Words.NOT_RECORDED, broken);
        }
    }
}
