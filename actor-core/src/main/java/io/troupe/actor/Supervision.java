package io.troupe.actor;

import java.time.Duration;

/**
 * What becomes of an actor when a one-way message, a timer, a reader of its callbacks, or {@link Actor#started()}
 * throws. (What a request throws is an answer to its asker; what a listener throws rejects the promise that
 * {@code then} answered.) The error is reported in any case.
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
 * @param directive what to do
 * @param limit so many failures within {@code window} are answered by the directive; one more stops the actor, and so
 *     does one more failed start in a row, within the window or not
 * @param window by the space's clock
 */
public record Supervision(Directive directive, int limit, Duration window) {
    /** What to do with an actor that has failed. */
    public enum Directive {
        /** Go on with the next message: the actor keeps its state. */
        RESUME,
        /**
         * Make a fresh instance behind the same proxy; timers and listeners of the old one are forgotten, the mailbox
         * is kept. A factory that throws stops the actor. If {@link Actor#started()} throws, the first try after that
         * follows at once, further ones after pauses of 10 ms, 20 ms, 40 ms and so on, at most 10 s, by the space's
         * clock, until one succeeds or the limit is reached; the actor's calls wait meanwhile.
         */
        RESTART,
        /** End it. */
        STOP
    }

    /** Go on, however often it fails; the default. */
    public static final Supervision RESUME =
            new Supervision(Directive.RESUME, Integer.MAX_VALUE, Duration.ofSeconds(1));

    /** End it at the first failure. */
    public static final Supervision STOP = new Supervision(Directive.STOP, Integer.MAX_VALUE, Duration.ofSeconds(1));

    public Supervision {
        if (limit < 0) {
            throw new IllegalArgumentException("limit is " + limit + ", expected 0 or more");
        }
        if (window.isNegative() || window.isZero()) {
            throw new IllegalArgumentException("window is " + window + ", expected more than zero");
        }
    }

    /** Make a fresh instance, up to so many times within a window; one more failure ends the actor. */
    public static Supervision restart(int limit, Duration window) {
        return new Supervision(Directive.RESTART, limit, window);
    }
}
