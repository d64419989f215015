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
 *         ActorSettings.defaults().withSupervision(Supervision.restart(2, Duration.ofSeconds(10)));
 * Counter counter = space.spawn(Counter.class, Counter::new, settings);
 * counter.add(-1); // restarts
 * counter.add(-1); // restarts
 * counter.add(-1); // the third failure within ten seconds: the actor stops
 * }
 *
 * <p>It may depend on the type of the error, and pause before each restart:
 *
 * {@snippet :
 * Supervision reconnecting = Supervision.restart(Duration.ofMinutes(1))
 *         .withPauses(Duration.ofMillis(100), Duration.ofSeconds(30)) // 100 ms, 200 ms, 400 ms and so on
 *         .on(IllegalArgumentException.class, Supervision.RESUME)
 *         .on(LinkageError.class, Supervision.STOP);
 * }
 */
public final class Supervision extends Settings<Supervision> {
    /** The action after a failure of an actor. */
    enum Directive {
        RESUME,
        RESTART,
        STOP
    }

    /** Another supervision for errors of a type. */
    private record Case(Class<? extends Throwable> type, Supervision supervision) {
        Case {
            Objects.requireNonNull(type, "type");
            Objects.requireNonNull(supervision, "supervision");
        }
    }

    /** Continue with the next message after every failure: the actor keeps its state. The default. */
    public static final Supervision RESUME =
            new Supervision(Directive.RESUME, Integer.MAX_VALUE, Duration.ofSeconds(1));

    /** Stop the actor at the first failure. */
    public static final Supervision STOP = new Supervision(Directive.STOP, Integer.MAX_VALUE, Duration.ofSeconds(1));

    private final Directive directive;
    private final int limit; // the failures within the window that are handled by the directive
    private final Duration window;
    private Duration firstPause = Duration.ZERO;
    private Duration longestPause = Duration.ZERO;
    private boolean requestsAndListeners;
    private List<Case> cases = List.of();

    private Supervision(Directive directive, int limit, Duration window) {
        this.directive = directive;
        this.limit = limit;
        this.window = window;
        check();
    }

    /**
     * Continue with the next message, up to {@code limit} times within a window; one more failure stops the actor.
     *
     * @param limit 0 or more
     * @param window measured by the space's clock
     */
    public static Supervision resume(int limit, Duration window) {
        return new Supervision(Directive.RESUME, limit, window);
    }

    /**
     * Create a new instance behind the same proxy, up to {@code limit} times within a window; one more failure stops
     * the actor, and so does one more failed start in a row, within the window or not.
     *
     * <p>Timers and listeners of the old instance are dropped, the mailbox is kept. A factory that throws stops the
     * actor. If {@link Actor#started()} throws, and the supervision has no pauses, the first retry follows immediately.
     * Further retries follow after pauses of 10 ms, 20 ms, 40 ms and so on, at most 10 s, by the space's clock, until
     * one succeeds or the limit is reached. Calls of the actor are held back meanwhile.
     *
     * @param limit 0 or more
     * @param window measured by the space's clock
     */
    public static Supervision restart(int limit, Duration window) {
        return new Supervision(Directive.RESTART, limit, window);
    }

    /**
     * The same without a limit.
     *
     * @param window after a run of this time without a failure, the pauses begin anew; see {@link #withPauses}
     */
    public static Supervision restart(Duration window) {
        return restart(Integer.MAX_VALUE, window);
    }

    @Override
    protected void check() {
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
    }

    /**
     * Pauses before each restart, by the space's clock; calls of the actor are held back meanwhile. The pause doubles
     * with each failure in a row. A row ends when the actor has run for the window without a failure; the limit then
     * applies to the failures of a row. By default there are no pauses.
     */
    public Supervision withPauses(Duration first, Duration longest) {
        return with(copy -> {
            copy.firstPause = first;
            copy.longestPause = longest;
        });
    }

    /**
     * Counts two more kinds of errors as failures of the actor: those that a request throws, in addition to rejecting
     * the caller's promise, and those that a listener of a promise throws on behalf of the actor. A request that
     * returns a promise which is rejected is no failure.
     */
    public Supervision withRequestsAndListeners() {
        return with(copy -> copy.requestsAndListeners = true);
    }

    /**
     * Another supervision for errors of a type, unless an earlier case matches.
     *
     * @param type of the error, or a supertype of it
     * @param other counts its failures separately, and may have cases
     */
    public Supervision on(Class<? extends Throwable> type, Supervision other) {
        var added = new Case(type, other);
        return with(copy ->
                copy.cases = Stream.concat(cases.stream(), Stream.of(added)).toList());
    }

    Supervision forError(Throwable error) {
        for (Case each : cases) {
            if (each.type.isInstance(error)) {
                return each.supervision.forError(error);
            }
        }
        return this;
    }

    Directive directive() {
        return directive;
    }

    int limit() {
        return limit;
    }

    Duration window() {
        return window;
    }

    Duration firstPause() {
        return firstPause;
    }

    Duration longestPause() {
        return longestPause;
    }

    boolean requestsAndListeners() {
        return requestsAndListeners;
    }

    boolean hasPauses() {
        return !firstPause.isZero();
    }
}
