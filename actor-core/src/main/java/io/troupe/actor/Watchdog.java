package io.troupe.actor;

import io.troupe.actor.time.Clock;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.locks.LockSupport;
import java.util.function.Consumer;

/**
 * Looks from aside whether a space gets on, on a virtual thread of its own. The space pays one plain store for each entry it serves.
 */
final class Watchdog {
    private static final int LOOKS_PER_LIMIT = 4;

    private static final System.Logger LOG = System.getLogger(Watchdog.class.getName());

    private final SpaceHome space;
    private final Lifeline lifeline;
    private final Dispatcher dispatcher;
    private final long limitNanos;
    private final Consumer<Stall> listener;

    private Watchdog(
            SpaceHome space, Lifeline lifeline, Dispatcher dispatcher, Duration limit, Consumer<Stall> listener) {
        this.space = space;
        this.lifeline = lifeline;
        this.dispatcher = dispatcher;
        this.limitNanos = SpaceHome.countedNanos(limit);
        this.listener = listener;
    }

    /** Watches until the space is closed. */
    static void watch(SpaceHome space, SpaceSettings settings, Lifeline lifeline, Dispatcher dispatcher) {
        if (!settings.stallLimit().isZero()) {
            var watchdog = new Watchdog(space, lifeline, dispatcher, settings.stallLimit(), settings.onStall());
            Thread.ofVirtual().name(settings.name() + "-watchdog").start(watchdog::run);
        }
    }

    private void run() {
        Clock clock = Clock.system();
        long seen = -1;
        long since = clock.nanos();
        boolean reported = false;
        while (!lifeline.isClosed()) {
            LockSupport.parkNanos(limitNanos / LOOKS_PER_LIMIT);
            recordFigures();
            long served = dispatcher.served();
            long now = clock.nanos();
            if (served != seen || lifeline.isAsleep()) {
                seen = served;
                since = now;
                reported = false;
            } else if (!reported && now - since >= limitNanos) {
                reported = true; // once for each message
                report(Duration.ofNanos(now - since));
            }
        }
    }

    private void report(Duration atLeast) {
        Thread busy = space.servingThread();
        if (busy == null) {
            return;
        }
        var stall = new Stall(space.toString(), atLeast, List.of(busy.getStackTrace()));
        new StallEvent(stall).commit();
        try {
            listener.accept(stall);
        } catch (Throwable broken) { // an Error must not end the watch
            LOG.log(System.Logger.Level.ERROR, "the stall listener of space " + space + " threw", broken);
        }
    }

    /** For the flight recorder, if it is on. */
    private void recordFigures() {
        var event = new SpaceFiguresEvent();
        if (event.isEnabled()) {
            event.fill(space);
            event.commit();
        }
    }
}
