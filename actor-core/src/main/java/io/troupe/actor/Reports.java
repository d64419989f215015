package io.troupe.actor;

import io.troupe.actor.RecorderEvents.DeadLetterEvent;
import io.troupe.actor.RecorderEvents.ErrorEvent;
import io.troupe.actor.internal.Message;
import io.troupe.actor.internal.Request;
import io.troupe.actor.internal.loop.Node;
import io.troupe.actor.internal.loop.Owner;
import io.troupe.actor.internal.loop.TimerWheel;
import io.troupe.actor.promise.Promise;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CancellationException;
import java.util.concurrent.atomic.LongAdder;
import org.jspecify.annotations.Nullable;

/** Reports and counts a space's unhandled errors and dead letters. Any thread. */
final class Reports {
    private static final System.Logger LOG = System.getLogger(ActorSpace.class.getName());

    private final SpaceHome space;
    private final SpaceSettings settings;
    private final LongAdder errors = new LongAdder();
    private final LongAdder deadLetters = new LongAdder();
    private final LongAdder shed = new LongAdder();
    private final LongAdder expired = new LongAdder();

    Reports(SpaceHome space, SpaceSettings settings) {
        this.space = space;
        this.settings = settings;
    }

    long errors() {
        return errors.sum();
    }

    long deadLetters() {
        return deadLetters.sum();
    }

    long shed() {
        return shed.sum();
    }

    long expired() {
        return expired.sum();
    }

    /** Counts a time limit that has passed. */
    void limitExpired() {
        expired.increment();
    }

    /**
     * Reports an error to the actor's handler if it has one, else to the space's. Never throws, whatever the error is
     * and whatever handlers throw, because the thread of the space depends on it. If there is no memory even for the
     * log, the error is only counted.
     *
     * @param what what failed, in words that end before the name of {@code whose}
     */
    void error(String what, Object whose, Throwable error, @Nullable ErrorHandler first) {
        try {
            errors.increment();
            String where = what + " " + whose;
            try {
                new ErrorEvent(settings.name(), where, error).commit();
            } finally {
                asItself(() -> (first != null ? first : settings.onError()).handle(where, error));
            }
        } catch (Throwable broken) {
            logBrokenHandler(what, error, broken);
        }
    }

    /** Calls a handler on the space's own behalf within the current turn; from any thread. */
    private void asItself(Runnable handler) {
        if (!space.isCurrent()) {
            handler.run();
            return;
        }
        Owner before = space.owner();
        space.beginForItself();
        try {
            handler.run();
        } finally {
            space.begin(before);
        }
    }

    private void logBrokenHandler(String what, Throwable error, Throwable broken) {
        try {
            if (broken != error) { // a handler may throw the error that it received
                broken.addSuppressed(error);
            }
            LOG.log(
                    System.Logger.Level.ERROR,
                    "the error handler of space " + settings.name() + " threw about " + what,
                    broken);
        } catch (Throwable again) {
            // the log fails too, or there is no memory: the error was counted
        }
    }

    void deadLetter(DeadLetter letter) {
        try {
            deadLetters.increment();
            try {
                new DeadLetterEvent(settings.name(), letter).commit();
            } finally {
                asItself(() -> settings.onDeadLetter().accept(letter));
            }
        } catch (Throwable broken) { // for example an AssertionError in a test
            error("the dead-letter handler of space " + settings.name() + ", about", letter, broken, null);
        }
    }

    /** Rejects a call that no actor will handle: notifies its sender, and the callbacks among its arguments. */
    void rejectCall(Node call, ActorCell cell, String reason, ActorException error) {
        if (call instanceof Request<?> request) {
            try {
                request.reject(error);
            } finally {
                endCallbacks(request, error);
            }
        } else if (call instanceof Message message) {
            deadLetter(new DeadLetter(cell.toString(), message.toString(), reason));
            endCallbacks(message, error);
        }
    }

    /** Counts a request that was cancelled or given up before it began, and ends its callbacks. */
    void skip(Request<?> request) {
        shed.increment();
        endCallbacks(request, new CancellationException(request.name() + " was cancelled or given up before it began"));
    }

    private static void endCallbacks(Node call, Exception error) {
        for (Object argument : Message.argumentsOf(call)) {
            if (argument instanceof ReturningCallback<?> callback) {
                callback.abandon(error);
            }
        }
    }

    /** The promises that were rejected without a listener, until they are reported. On the space's thread. */
    static final class Rejections {
        private record Lost(Promise<?> promise, Throwable error) {}

        private static final long GRACE_NANOS = 1_000_000_000;

        private final TimerWheel timers;
        private final Reports reports;
        private final List<Lost> lost = new ArrayList<>();
        private final Map<Promise<?>, Throwable> held = new LinkedHashMap<>();

        Rejections(TimerWheel timers, Reports reports) {
            this.timers = timers;
            this.reports = reports;
        }

        void add(Promise<?> promise, Throwable error) {
            lost.add(new Lost(promise, error));
        }

        /** Keeps a rejection for a while, because its caller on another thread may be about to register a listener. */
        void hold(Promise<?> promise, Throwable error) {
            held.put(promise, error);
            timers.set(() -> release(promise), GRACE_NANOS, 0);
        }

        private void release(Promise<?> promise) {
            Throwable error = held.remove(promise);
            if (error != null) {
                add(promise, error);
            }
        }

        void releaseAll() {
            List.copyOf(held.keySet()).forEach(this::release);
        }

        /** Reports the promises that still have no listener. */
        void report() {
            if (lost.isEmpty()) {
                return;
            }
            var candidates = List.copyOf(lost);
            lost.clear();
            for (var candidate : candidates) {
                if (!Request.isHandled(candidate.promise)) {
                    Object name = candidate.promise instanceof Request<?> request ? request.name() : candidate.promise;
                    reports.error("a rejected promise without a listener:", name, candidate.error, null);
                }
            }
        }
    }
}
