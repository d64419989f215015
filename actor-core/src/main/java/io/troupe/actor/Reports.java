package io.troupe.actor;

import io.troupe.actor.promise.Node;
import java.util.concurrent.CancellationException;
import java.util.concurrent.atomic.LongAdder;
import org.jspecify.annotations.Nullable;

/** Where a space tells of what nobody else could be told, and how often it had to. Any thread. */
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

    /** To the actor's handler if it has one, else to the space's. */
    void error(String where, Throwable error, @Nullable ErrorHandler first) {
        errors.increment();
        new ErrorEvent(settings.name(), where, error).commit();
        try {
            space.asItself(() -> (first != null ? first : settings.onError()).handle(where, error));
        } catch (Throwable broken) {
            if (broken != error) { // a handler may throw what it was given
                broken.addSuppressed(error);
            }
            LOG.log(
                    System.Logger.Level.ERROR,
                    "the error handler of space " + settings.name() + " threw about " + where,
                    broken);
        }
        rethrowIfFatal(error);
    }

    /** A virtual machine that cannot go on must not be talked over. */
    static void rethrowIfFatal(Throwable error) {
        if (error instanceof VirtualMachineError fatal
                && !(error instanceof StackOverflowError)
                && !(error instanceof OutOfMemoryError)) { // one actor that asks for too much must not end all others
            throw fatal;
        }
    }

    void deadLetter(DeadLetter letter) {
        deadLetters.increment();
        new DeadLetterEvent(settings.name(), letter).commit();
        try {
            space.asItself(() -> settings.onDeadLetter().accept(letter));
        } catch (Throwable broken) { // an AssertionError in a test, say
            error("the dead-letter handler of space " + settings.name() + ", about " + letter, broken, null);
        }
    }

    /** Turns away a call that no actor will handle: its sender, and whoever listens to a callback among its arguments, hear of it. */
    void turnAway(Node call, ActorCell cell, String reason, ActorException error) {
        if (call instanceof Request<?> request) {
            request.reject(error);
            endCallbacks(request.arguments(), error);
        } else if (call instanceof Message message) {
            deadLetter(new DeadLetter(cell.toString(), message.toString(), reason));
            endCallbacks(message.arguments(), error);
        }
    }

    /** A request was cancelled before it began. */
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
