package io.troupe.actor;

import java.time.Duration;
import java.util.List;
import java.util.Objects;
import java.util.stream.Stream;

/**
 * What happens to an actor when a one-way message, a timer, a {@link Callback} that it passed to another actor, or
 * {@link Actor#started()} throws. (An exception of a request rejects the caller's promise; an exception of a listener
 * rejects the promise that {@code then} returned. Neither is a failure of the actor without
 * {@link #withRequestsAndListeners}.) The error is always reported.
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
 * <p>It may depend on the type of the error, and pause before each restart:
 *
 * {@snippet :
 * Supervision reconnecting = Supervision.restart(Integer.MAX_VALUE, Duration.ofMinutes(1))
 *         .withPauses(Duration.ofMillis(100), Duration.ofSeconds(30)) // 100 ms, 200 ms, 400 ms and so on
 *         .on(IllegalArgumentException.class, Supervision.RESUME)
 *         .on(LinkageError.class, Supervision.STOP);
 * }
 *
 * @param directive the action
 * @param limit the number of failures within {@code window} that are handled by the directive. One more stops the
 *     actor, and so does one more failed start in a row, within the window or not
 * @param window measured by the space's clock
 * @param firstPause the pause before a restart, zero for none; see {@link #withPauses}
 * @param longestPause the limit of the pauses, which double
 * @param requestsAndListeners whether exceptions of requests and listeners count; see {@link #withRequestsAndListeners}
 * @param cases the errors for which another supervision applies; the first one that matches does
 */
public record Supervision(
        Directive directive,
        int limit,
        Duration window,
        Duration firstPause,
        Duration longestPause,
        boolean requestsAndListeners,
        List<Case> cases) {
    /** The action after a failure of an actor. */
    public enum Directive {
        /** Continue with the next message: the actor keeps its state. */
        RESUME,
        /**
         * Create a new instance behind the same proxy. Timers and listeners of the old instance are dropped, the
         * mailbox is kept. A factory that throws stops the actor. If {@link Actor#started()} throws, and the
         * supervision has no pauses, the first retry follows immediately. Further retries follow after pauses of 10 ms,
         * 20 ms, 40 ms and so on, at most 10 s, by the space's clock, until one succeeds or the limit is reached. Calls
         * of the actor are held back meanwhile.
         */
        RESTART,
        /** Stop the actor. */
        STOP
    }

    /**
     * A supervision for certain errors.
     *
     * @param type of the error, or a supertype of it
     * @param supervision counts its failures separately, and may have cases
     */
    public record Case(Class<? extends Throwable> type, Supervision supervision) {
        public Case {
            Objects.requireNonNull(type, "type");
            Objects.requireNonNull(supervision, "supervision");
        }
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
        if (firstPause.isNegative() || firstPause.compareTo(longestPause) > 0) {
            throw new IllegalArgumentException("firstPause is " + firstPause
                    + ", expected between zero and longestPause, which is " + longestPause);
        }
        if (directive != Directive.RESTART && !firstPause.isZero()) {
            throw new IllegalArgumentException(
                    "firstPause is " + firstPause + ", expected zero: nothing is restarted after " + directive);
        }
        cases = List.copyOf(cases);
    }

    /** Without pauses and cases, and requests and listeners do not count. */
    public Supervision(Directive directive, int limit, Duration window) {
        this(directive, limit, window, Duration.ZERO, Duration.ZERO, false, List.of());
    }

    /** Create a new instance, up to {@code limit} times within a window; one more failure stops the actor. */
    public static Supervision restart(int limit, Duration window) {
        return new Supervision(Directive.RESTART, limit, window);
    }

    /**
     * Pauses before each restart, by the space's clock; calls of the actor are held back meanwhile. The pause doubles
     * with each failure in a row. A row ends when the actor has run for the window without a failure; the limit then
     * applies to the failures of a row.
     */
    public Supervision withPauses(Duration first, Duration longest) {
        return new Supervision(directive, limit, window, first, longest, requestsAndListeners, cases);
    }

    /**
     * Counts two more kinds of errors as failures of the actor: those that a request throws, in addition to rejecting
     * the caller's promise, and those that a listener of a promise throws on behalf of the actor. A request that
     * returns a promise which is rejected is no failure.
     */
    public Supervision withRequestsAndListeners() {
        return new Supervision(directive, limit, window, firstPause, longestPause, true, cases);
    }

    /** Another supervision for errors of a type, unless an earlier case matches; it counts its failures separately. */
    public Supervision on(Class<? extends Throwable> type, Supervision other) {
        List<Case> more =
                Stream.concat(cases.stream(), Stream.of(new Case(type, other))).toList();
        return new Supervision(directive, limit, window, firstPause, longestPause, requestsAndListeners, more);
    }

    Supervision forError(Throwable error) {
        for (Case each : cases) {
            if (each.type.isInstance(error)) {
                return each.supervision.forError(error);
            }
        }
        return this;
    }

    boolean hasPauses() {
        return !firstPause.isZero();
    }
}
