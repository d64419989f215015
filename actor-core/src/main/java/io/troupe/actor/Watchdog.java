package io.troupe.actor;

import io.troupe.actor.RecorderEvents.SpaceFiguresEvent;
import io.troupe.actor.RecorderEvents.StallEvent;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.time.Clock;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * Detects stalled spaces from a separate thread. It costs the space one plain store for each entry.
 *
 * <p><b>Threads.</b> One platform thread checks all watched spaces; it starts with the first and ends soon after the
 * last. What takes time, the stall listener and the flight recorder, runs on one of the {@link HelperThreads}.
 */
final class Watchdog {
    private static final int LOOKS_PER_LIMIT = 4;

    private static final System.Logger LOG = System.getLogger(Watchdog.class.getName());
    private static final TimerThread LOOKS = new TimerThread("troupe-watchdog");
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

    private Watchdog(
            SpaceHome space, IdleStrategy idle, Dispatcher dispatcher, Duration limit, Consumer<Stall> listener) {
        this.space = space;
        this.idle = idle;
        this.dispatcher = dispatcher;
        this.limitNanos = Home.nanosOf(limit);
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
        if (settings.stallLimit().isZero()) {
            return null;
        }
        var watchdog = new Watchdog(space, idle, dispatcher, settings.stallLimit(), settings.onStall());
        long period = Math.max(1, watchdog.limitNanos / LOOKS_PER_LIMIT);
        var looks = LOOKS.scheduleWithFixedDelay(watchdog::look, period, period, TimeUnit.NANOSECONDS);
        return () -> looks.cancel(false);
    }

    /** Checks the space; throws nothing, because that would end the schedule. */
    private void look() {
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
        HelperThreads.run(space + "-stall", () -> notifyListener(stall));
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
                HelperThreads.run(space + "-figures", this::recordFigures);
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
