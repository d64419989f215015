package io.troupe.actor;

import io.troupe.actor.RecorderEvents.DeadLetterEvent;
import io.troupe.actor.RecorderEvents.ErrorEvent;
import io.troupe.actor.promise.Node;
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
                space.asItself(() -> (first != null ? first : settings.onError()).handle(where, error));
            }
        } catch (Throwable broken) {
            logBrokenHandler(what, error, broken);
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
                space.asItself(() -> settings.onDeadLetter().accept(letter));
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
                endCallbacks(request.arguments(), error);
            }
        } else if (call instanceof Message message) {
            deadLetter(new DeadLetter(cell.toString(), message.toString(), reason));
            endCallbacks(message.arguments(), error);
        }
    }

    /** Ends the callbacks of a request that was cancelled before it began. */
    void skip(Request<?> request) {
        endCallbacks(request.arguments(), new CancellationException(request + " was cancelled before it began"));
    }

    private static void endCallbacks(@Nullable Object[] arguments, Exception error) {
        for (Object argument : arguments) {
            if (argument instanceof ReturningCallback<?> callback) {
                callback.abandon(error);
            }
        }
    }
}
