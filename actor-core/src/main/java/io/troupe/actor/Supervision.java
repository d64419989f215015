package io.troupe.actor;

import java.time.Duration;

/**
 * What happens to an actor when a one-way message, a timer, a {@link Callback} that it passed to another actor, or
 * {@link Actor#started()} throws. (An exception of a request rejects the caller's promise; an exception of a listener
 * rejects the promise that {@code then} returned.) The error is always reported.
 *
 * {@snippet :
 * ActorSettings settings =
 *         ActorSettings.DEFAULT.withSupervision(Supervision.restart(2, Duration.ofSeconds(10)));
 * Counter counter = space.spawn(Counter.class, Counter::new, settings);
 * counter.add(-1); // restarts
 * counter.add(-1); // restarts
 * counter.add(-1); // the third failure within ten seconds: the actor stops
 * }
 *
 * @param directive the action
 * @param limit the number of failures within {@code window} that are handled by the directive. One more stops the
 *     actor, and so does one more failed start in a row, within the window or not
 * @param window measured by the space's clock
 */
public record Supervision(Directive directive, int limit, Duration window) {
    /** The action after a failure of an actor. */
    public enum Directive {
        /** Continue with the next message: the actor keeps its state. */
        RESUME,
        /**
         * Create a new instance behind the same proxy. Timers and listeners of the old instance are dropped, the
         * mailbox is kept. A factory that throws stops the actor. If {@link Actor#started()} throws, the first retry
         * follows immediately. Further retries follow after pauses of 10 ms, 20 ms, 40 ms and so on, at most 10 s, by
         * the space's clock, until one succeeds or the limit is reached. Calls of the actor are held back meanwhile.
         */
        RESTART,
        /** Stop the actor. */
        STOP
    }

    /** Continue after every failure; the default. */
    public static final Supervision RESUME =
            new Supervision(Directive.RESUME, Integer.MAX_VALUE, Duration.ofSeconds(1));

    /** Stop the actor at the first failure. */
    public static final Supervision STOP = new Supervision(Directive.STOP, Integer.MAX_VALUE, Duration.ofSeconds(1));

    public Supervision {
        if (limit < 0) {
            throw new IllegalArgumentException("limit is " + limit + ", expected 0 or more");
        }
        if (window.isNegative() || window.isZero()) {
            throw new IllegalArgumentException("window is " + window + ", expected more than zero");
        }
    }

    /** Create a new instance, up to {@code limit} times within a window; one more failure stops the actor. */
    public static Supervision restart(int limit, Duration window) {
        return new Supervision(Directive.RESTART, limit, window);
    }
}
