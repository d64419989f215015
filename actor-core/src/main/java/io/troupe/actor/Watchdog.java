package io.troupe.actor;

import io.troupe.actor.time.Clock;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.ScheduledThreadPoolExecutor;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * Looks from aside whether a space gets on. The space pays one plain store for each entry it serves.
 *
 * <p><b>Threads.</b> One platform thread looks at all spaces that are watched; it begins with the first and ends soon
 * after the last. What a look leads to that takes time, the listener and the flight recorder, runs on one of the
 * {@link HelperThreads}.
 */
final class Watchdog {
    private static final int LOOKS_PER_LIMIT = 4;
    private static final long IDLE_SECONDS = 10;

    private static final System.Logger LOG = System.getLogger(Watchdog.class.getName());
    private static final ScheduledThreadPoolExecutor LOOKS = looks();
    private static final boolean CAN_RECORD = loadEvents();

    private final SpaceHome space;
    private final Lifeline lifeline;
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
            SpaceHome space, Lifeline lifeline, Dispatcher dispatcher, Duration limit, Consumer<Stall> listener) {
        this.space = space;
        this.lifeline = lifeline;
        this.dispatcher = dispatcher;
        this.limitNanos = SpaceHome.countedNanos(limit);
        this.listener = listener;
    }

    private static ScheduledThreadPoolExecutor looks() {
        var looks = new ScheduledThreadPoolExecutor(
                1,
                Thread.ofPlatform()
                        .daemon()
                        .inheritInheritableThreadLocals(false)
                        .name("troupe-watchdog")
                        .factory());
        looks.setRemoveOnCancelPolicy(true);
        looks.setKeepAliveTime(IDLE_SECONDS, TimeUnit.SECONDS);
        looks.allowCoreThreadTimeOut(true); // not while a look is due some time
        return looks;
    }

    /** Before the first look, not when memory is short. */
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
     * @return ends that, or null if the space is not to be watched
     */
    static @Nullable Runnable watch(SpaceHome space, SpaceSettings settings, Lifeline lifeline, Dispatcher dispatcher) {
        if (settings.stallLimit().isZero()) {
            return null;
        }
        var watchdog = new Watchdog(space, lifeline, dispatcher, settings.stallLimit(), settings.onStall());
        long period = Math.max(1, watchdog.limitNanos / LOOKS_PER_LIMIT);
        var looks = LOOKS.scheduleWithFixedDelay(watchdog::look, period, period, TimeUnit.NANOSECONDS);
        return () -> looks.cancel(false);
    }

    /** Throws nothing: that would end the watch. */
    private void look() {
        try {
            long served = dispatcher.served();
            long now = clock.nanos();
            if (served != seen || lifeline.isAsleep()) {
                seen = served;
                since = now;
                reported = false;
            } else if (!reported && now - since >= limitNanos) {
                report(served, now - since);
            }
            failed = false;
        } catch (Throwable broken) { // no memory, say: the next look may do better
            if (!failed) {
                failed = true;
                log("the watchdog of space " + space + " failed", broken);
            }
        }
        startRecording();
    }

    private static void log(String what, Throwable broken) {
        try {
            LOG.log(System.Logger.Level.ERROR, what, broken);
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
        if (served != dispatcher.served() || lifeline.isAsleep() || !isInATurn(stack)) {
            return; // it was just about to go on, or it waits for a processor, which is nobody's fault here
        }
        var stall = new Stall(space.toString(), Duration.ofNanos(nanos), stack);
        HelperThreads.run(space + "-stall", () -> tell(stall)); // which may take its time, others are watched too
        reported = true; // once for each message
    }

    private void tell(Stall stall) {
        if (recording) {
            record(() -> new StallEvent(stall).commit());
        }
        try {
            listener.accept(stall);
        } catch (Throwable broken) {
            log("the stall listener of space " + space + " threw", broken);
        }
    }

    /**
     * Whether what the thread does is the work of an entry or of a handler, and not the loop of the space itself, or
     * sleep.
     */
    static boolean isInATurn(List<StackTraceElement> stack) {
        return stack.stream().anyMatch(Watchdog::isATurn);
    }

    private static boolean isATurn(StackTraceElement frame) {
        String type = frame.getClassName();
        return type.equals(Dispatcher.class.getName())
                        && (frame.getMethodName().equals("serveOne")
                                || frame.getMethodName().equals("runTask"))
                || type.equals(Sequence.class.getName())
                || type.equals(Reports.class.getName());
    }

    /** For the flight recorder, if it is on. */
    private void startRecording() {
        if (recording) {
            record(() -> {
                if (new SpaceFiguresEvent().isEnabled()) {
                    HelperThreads.run(space + "-figures", () -> record(this::recordFigures));
                }
            });
        }
    }

    private void recordFigures() {
        var event = new SpaceFiguresEvent();
        event.fill(space);
        event.commit();
    }

    /** The watch does not depend on the recorder: after an error nothing of this space is recorded any more. */
    private void record(Runnable step) {
        try {
            step.run();
        } catch (Throwable broken) {
            recording = false;
            log("space " + space + " records no more figures and stalls", broken);
        }
    }
}
