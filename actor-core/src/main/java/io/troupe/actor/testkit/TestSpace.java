package io.troupe.actor.testkit;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.CallObserver;
import io.troupe.actor.DeadLetter;
import io.troupe.actor.ManualClock;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.internal.loop.PlainText;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Objects;
import java.util.concurrent.TimeoutException;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * An actor space for tests: no thread, a manual clock, the same code as in production.
 *
 * <p><b>Role.</b> Created in a try-with-resources statement of a test, or closed with {@link #close} at its end.
 * Closing fails the test if errors, dead letters or queued messages are left.
 *
 * {@snippet :
 * try (var test = new TestSpace()) {
 *     Heater heater = test.spawn(Heater.class, Heater::new);
 *     test.advance(Duration.ofMinutes(2));
 *     assertThat(test.get(heater.degrees())).isEqualTo(20);
 * } // close() fails the test if an error or a message was forgotten
 * }
 *
 * <p><b>Threads.</b> The test's thread, which is the space's thread during {@link #runQueued}.
 */
public final class TestSpace implements AutoCloseable {
    /** An error that had no listener or caller to receive it. */
    public record Problem(String where, Throwable error) {}

    private final ManualClock clock = new ManualClock();
    private final List<Problem> problems = new ArrayList<>();
    private final List<DeadLetter> deadLetters = new ArrayList<>();
    private final List<Probe<?>> probes = new ArrayList<>();
    private final ActorSpace space;

    /** Creates a space whose clock shows 0. */
    public TestSpace() {
        this(null);
    }

    /** Creates a space whose clock shows 0, and whose calls are observed, for example by a {@link RingFinder}. */
    public TestSpace(@Nullable CallObserver observer) {
        var settings = SpaceSettings.named("test-space")
                .withClock(clock)
                .withOnError((where, error) -> problems.add(new Problem(where, error)))
                .withOnDeadLetter(deadLetters::add)
                .withoutThread();
        space = ActorSpace.create(observer == null ? settings : settings.withCallObserver(observer));
    }

    public ActorSpace space() {
        return space;
    }

    public ManualClock clock() {
        return clock;
    }

    /** Creates an actor and starts it. */
    public <A> A spawn(Class<A> type, Supplier<? extends A> factory) {
        A proxy = space.spawn(type, factory);
        runQueued();
        return proxy;
    }

    /** Creates an actor with settings and starts it. */
    public <A> A spawn(Class<A> type, Supplier<? extends A> factory, ActorSettings settings) {
        A proxy = space.spawn(type, factory, settings);
        runQueued();
        return proxy;
    }

    /**
     * Creates a test double for an actor that records its calls; a request it has not answered at the end fails the
     * test.
     */
    public <A> Probe<A> probe(Class<A> type) {
        var probe = new Probe<>(this, type);
        probes.add(probe);
        return probe;
    }

    /** Creates a callback that records its results and its end. */
    public <T extends @Nullable Object> CallbackProbe<T> callback() {
        return new CallbackProbe<>(this);
    }

    /** Runs everything that is queued, and what follows from it, until nothing is queued. */
    public void runQueued() {
        space.runQueued();
    }

    /** Runs a task on the space's thread, and what follows from it. */
    public void run(Runnable task) {
        space.execute(task);
        runQueued();
    }

    /**
     * Runs everything that is queued, then moves the clock from one timer to the next, and runs what is due at each
     * step and what follows from it. A periodic timer runs once for each period.
     *
     * <p>Other spaces may share this clock: a space with a thread wakes up at each step and runs concurrently with the
     * test, a space without a thread is not run by this.
     *
     * @throws IllegalArgumentException if the duration is negative
     */
    public void advance(Duration duration) {
        if (duration.isNegative()) {
            throw new IllegalArgumentException("a clock does not go back: by " + duration);
        }
        long end = Math.addExact(clock.nanos(), duration.toNanos());
        runQueued();
        for (long next = space.nextTimerNanos(); next < end; next = space.nextTimerNanos()) {
            clock.advanceToAtLeast(next);
            runQueued();
        }
        clock.advanceToAtLeast(end);
        runQueued();
    }

    /**
     * The value of a promise, after running everything that is queued. A rejected promise throws its own error
     * unchanged, even a checked one.
     *
     * @throws AssertionError if it is still pending: nothing in the space can settle it unless the clock moves
     */
    public <T extends @Nullable Object> T get(Promise<T> promise) {
        runQueued();
        if (!promise.isDone()) {
            int timers = space.metrics().timers();
            throw new AssertionError("nothing is left to do, and " + promise + " is still pending"
                    + (timers == 0 ? "" : "; timers that wait for advance(..): " + timers));
        }
        withdrawUnhandled(promise);
        try {
            return promise.get(Duration.ZERO);
        } catch (InterruptedException | TimeoutException rejection) { // a settled promise does not wait
            throw TestSpace.<RuntimeException>unchecked(rejection);
        }
    }

    @SuppressWarnings("unchecked") // throws a checked exception as an unchecked one, on purpose
    private static <E extends Throwable> E unchecked(Throwable error) throws E {
        throw (E) error;
    }

    /** The error of a promise, after running everything that is queued. */
    public Throwable error(Promise<?> promise) {
        promise.onRejected(ignored -> {}); // the test counts as a listener
        runQueued();
        Throwable error = promise.error();
        if (error == null) {
            throw new AssertionError(promise + (promise.isDone() ? " was fulfilled" : " is still pending")
                    + ", expected it to be rejected");
        }
        withdrawUnhandled(promise);
        return error;
    }

    /**
     * Removes the report of a rejection that the test now reads; it was reported because the clock moved before the
     * test registered a listener.
     */
    private void withdrawUnhandled(Promise<?> promise) {
        problems.removeIf(problem -> problem.error() == promise.error()
                && problem.where().startsWith("a rejected promise without a listener"));
    }

    /** Removes and returns the reported problems; they no longer fail the test. */
    public List<Problem> takeProblems() {
        var taken = List.copyOf(problems);
        problems.clear();
        return taken;
    }

    /** Removes and returns the dead letters; they no longer fail the test. */
    public List<DeadLetter> takeDeadLetters() {
        var taken = List.copyOf(deadLetters);
        deadLetters.clear();
        return taken;
    }

    /** The error; or, since build tools may lose a failure that cannot be printed, one that can. */
    private static Throwable printable(Throwable error) {
        try {
            Objects.requireNonNull(error.toString());
            return error;
        } catch (Throwable unprintable) {
            var shown = new AssertionError(PlainText.of(error));
            shown.setStackTrace(error.getStackTrace());
            return shown;
        }
    }

    /**
     * Closes the space.
     *
     * @throws AssertionError if something was left: queued messages, problems or dead letters that were not taken,
     *     requests that a probe did not answer
     */
    @Override
    public void close() {
        boolean quiet = space.isQuiet();
        space.close();
        if (!problems.isEmpty()) {
            var failure = new AssertionError("the space reported " + problems.size() + " problem(s), the first in "
                    + problems.getFirst().where() + "; if they are expected, takeProblems()");
            problems.forEach(problem -> failure.addSuppressed(printable(problem.error())));
            throw failure;
        }
        if (!deadLetters.isEmpty()) {
            throw new AssertionError(
                    "messages became dead letters: " + deadLetters + "; if they are expected, takeDeadLetters()");
        }
        for (var probe : probes) {
            var unanswered = probe.removeUnanswered();
            if (!unanswered.isEmpty()) {
                throw new AssertionError(probe + ": requests were never answered: " + unanswered
                        + "; answer(..) them, or takeUnanswered()");
            }
        }
        if (!quiet) {
            throw new AssertionError(
                    "the test ended while messages waited in the space: runQueued() it, or take out what waits");
        }
    }
}
