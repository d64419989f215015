package io.troupe.actor.testkit;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.DeadLetter;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.ManualClock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeoutException;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * An actor space for tests: no thread of its own, a clock that stands still, the same code as in production.
 *
 * <p><b>Role.</b> Made in a test, in a try-with-resources or with {@link #close} at its end: that is where forgotten
 * errors, dead letters and unserved messages fail the test.
 *
 * {@snippet :
 * try (var test = new TestSpace()) {
 *     Heater heater = test.spawn(Heater.class, Heater::new);
 *     test.advance(Duration.ofMinutes(2));
 *     assertThat(test.get(heater.degrees())).isEqualTo(20);
 * } // close() fails the test if an error or a message was forgotten
 * }
 *
 * <p><b>Threads.</b> The test's thread; it is the space's thread while it cranks.
 */
public final class TestSpace implements AutoCloseable {
    /** Something that went wrong where nobody else could be told. */
    public record Problem(String where, Throwable error) {}

    private final ManualClock clock = new ManualClock();
    private final List<Problem> problems = new ArrayList<>();
    private final List<DeadLetter> deadLetters = new ArrayList<>();
    private final List<Probe<?>> probes = new ArrayList<>();
    private final ActorSpace space = ActorSpace.create(SpaceSettings.named("test-space")
            .withClock(clock)
            .withOnError((where, error) -> problems.add(new Problem(where, error)))
            .withOnDeadLetter(deadLetters::add)
            .withHandCrank());

    public ActorSpace space() {
        return space;
    }

    public ManualClock clock() {
        return clock;
    }

    /** Makes an actor and lets it start. */
    public <A> A spawn(Class<A> type, Supplier<? extends A> factory) {
        A proxy = space.spawn(type, factory);
        crank();
        return proxy;
    }

    /** Makes an actor with settings, and lets it start. */
    public <A> A spawn(Class<A> type, Supplier<? extends A> factory, ActorSettings settings) {
        A proxy = space.spawn(type, factory, settings);
        crank();
        return proxy;
    }

    /** A stand-in for an actor, that records its calls; a request it has not answered at the end fails the test. */
    public <A> Probe<A> probe(Class<A> type) {
        var probe = new Probe<>(this, type);
        probes.add(probe);
        return probe;
    }

    /** A callback that records what it hears. */
    public <T extends @Nullable Object> CallbackProbe<T> callback() {
        return new CallbackProbe<>(this);
    }

    /** Serves what waits, and what comes of it, until nothing waits. */
    public void crank() {
        space.crank();
    }

    /** Runs a task on the space's thread, and serves what comes of it. */
    public void run(Runnable task) {
        space.execute(task);
        crank();
    }

    /**
     * Serves what waits, then moves the clock from one timer to the next, and serves what is due and what comes of it,
     * each at its own time. A periodic timer runs once for each period that is over.
     *
     * <p>Other spaces may share this clock: one with a thread is woken at each step and runs beside the test, one that
     * is cranked by hand is not cranked by this.
     *
     * @throws IllegalArgumentException if the duration is negative
     */
    public void advance(Duration duration) {
        if (duration.isNegative()) {
            throw new IllegalArgumentException("a clock does not go back: by " + duration);
        }
        long end = Math.addExact(clock.nanos(), duration.toNanos());
        crank();
        for (long next = space.nextTimerNanos(); next < end; next = space.nextTimerNanos()) {
            clock.advanceToAtLeast(next);
            crank();
        }
        clock.advanceToAtLeast(end);
        crank();
    }

    /**
     * The value of a promise, after serving what waits. A rejected promise throws its own error as it is, a checked one
     * too.
     *
     * @throws AssertionError if it is not settled then: nothing in the space could settle it any more, unless the clock
     *     moves
     */
    public <T extends @Nullable Object> T get(Promise<T> promise) {
        crank();
        if (!promise.isDone()) {
            int timers = space.metrics().timers();
            throw new AssertionError("nothing is left to do, and " + promise + " is still pending"
                    + (timers == 0 ? "" : "; timers that wait for advance(..): " + timers));
        }
        withdrawUnheard(promise);
        try {
            return promise.get(Duration.ZERO);
        } catch (InterruptedException | TimeoutException rejection) { // a settled promise does not wait
            throw TestSpace.<RuntimeException>unchecked(rejection);
        }
    }

    @SuppressWarnings("unchecked") // unchecked by the compiler: that is the point
    private static <E extends Throwable> E unchecked(Throwable error) throws E {
        throw (E) error;
    }

    /** The error of a promise, after serving what waits. */
    public Throwable error(Promise<?> promise) {
        promise.handle((value, ignored) -> null); // somebody listens: the test
        crank();
        Throwable error = promise.error();
        if (error == null) {
            throw new AssertionError(promise + (promise.isDone() ? " was fulfilled" : " is still pending")
                    + ", expected it to be rejected");
        }
        withdrawUnheard(promise);
        return error;
    }

    /** The test looks at a rejection that was reported, because the clock went on, before the test could listen. */
    private void withdrawUnheard(Promise<?> promise) {
        problems.removeIf(problem ->
                problem.error() == promise.error() && problem.where().startsWith("a promise nobody listens to"));
    }

    /** What has been reported so far; taking it says that the test expected it. */
    public List<Problem> takeProblems() {
        var taken = List.copyOf(problems);
        problems.clear();
        return taken;
    }

    /** What has reached nobody so far; taking it says that the test expected it. */
    public List<DeadLetter> takeDeadLetters() {
        var taken = List.copyOf(deadLetters);
        deadLetters.clear();
        return taken;
    }

    /**
     * Closes the space.
     *
     * @throws AssertionError if something was left: messages nobody served, problems or dead letters nobody took,
     *     requests no probe answered
     */
    @Override
    public void close() {
        boolean quiet = space.isQuiet();
        space.close();
        if (!problems.isEmpty()) {
            var failure = new AssertionError("the space reported " + problems.size() + " problem(s), the first in "
                    + problems.getFirst().where());
            problems.forEach(problem -> failure.addSuppressed(problem.error()));
            throw failure;
        }
        if (!deadLetters.isEmpty()) {
            throw new AssertionError("messages reached nobody: " + deadLetters);
        }
        for (var probe : probes) {
            var unanswered = probe.removeUnanswered();
            if (!unanswered.isEmpty()) {
                throw new AssertionError(probe + ": requests were never answered: " + unanswered
                        + "; answer(..) them, or takeUnanswered()");
            }
        }
        if (!quiet) {
            throw new AssertionError("the test ended while messages waited in the space: crank() it, or say why not");
        }
    }
}
