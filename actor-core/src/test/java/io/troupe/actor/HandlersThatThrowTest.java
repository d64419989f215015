package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.ManualClock;
import java.time.Duration;
import java.time.temporal.ChronoUnit;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicInteger;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** User code that the space itself calls may throw: handlers, hooks, and {@code toString} of arguments and errors. */
@Timeout(20)
class HandlersThatThrowTest {
    private final List<String> log = new ArrayList<>();

    private static SpaceSettings quiet() {
        return SpaceSettings.named("handlers").withClock(new ManualClock()).withHandCrank();
    }

    /** Has methods that fail, and methods that take any argument. */
    public interface Worker {
        void fail(RuntimeException error);

        void take(Object anything);

        Promise<Integer> ask(Object anything);
    }

    /** The implementation. */
    static class Steady implements Worker {
        private final List<String> log;

        Steady(List<String> log) {
            this.log = log;
            log.add("made");
        }

        @Override
        public void fail(RuntimeException error) {
            throw error;
        }

        @Override
        public void take(Object anything) {
            log.add("took");
        }

        @Override
        public Promise<Integer> ask(Object anything) {
            return Promise.of(1);
        }
    }

    private static final class Sourpuss {
        @Override
        public String toString() {
            throw new StackOverflowError("a list that contains itself has no text");
        }
    }

    private static final class Unspeakable extends RuntimeException {
        private static final long serialVersionUID = 1;

        @Override
        public String getMessage() {
            throw new IllegalStateException("this error's text cannot be made");
        }
    }

    @Test
    void errorHandler_throwsWhatItWasGiven_spaceGoesOn() throws Exception {
        var space = ActorSpace.create(SpaceSettings.named("rethrowing").withOnError((where, error) -> {
            throw (RuntimeException) error;
        }));
        Worker worker = space.spawn(Worker.class, () -> new Steady(log));
        worker.fail(new IllegalStateException("failed"));
        assertThat(worker.ask(1).get(Duration.ofSeconds(5))).isEqualTo(1);
        space.close();
    }

    @Test
    void supervision_errorHandlerThrowsWhatItWasGiven_stillRestarts() {
        var space = ActorSpace.create(quiet().withOnError((where, error) -> {
            throw (RuntimeException) error;
        }));
        Worker worker = space.spawn(
                Worker.class,
                () -> new Steady(log),
                ActorSettings.DEFAULT.withSupervision(Supervision.restart(3, Duration.ofSeconds(1))));
        worker.fail(new IllegalStateException("failed"));
        space.crank();
        assertThat(log).containsExactly("made", "made");
        space.close();
    }

    @Test
    void supervision_errorWhoseTextThrows_stillRestarts() {
        var space = ActorSpace.create(quiet().withOnError((where, error) -> {}));
        Worker worker = space.spawn(
                Worker.class,
                () -> new Steady(log),
                ActorSettings.DEFAULT.withSupervision(Supervision.restart(3, Duration.ofSeconds(1))));
        worker.fail(new Unspeakable());
        space.crank();
        assertThat(log).containsExactly("made", "made");
        space.close();
    }

    @Test
    void supervision_windowForEver_stillRestarts() {
        var space = ActorSpace.create(quiet().withOnError((where, error) -> {}));
        Worker worker = space.spawn(
                Worker.class,
                () -> new Steady(log),
                ActorSettings.DEFAULT.withSupervision(Supervision.restart(3, ChronoUnit.FOREVER.getDuration())));
        worker.fail(new IllegalStateException("failed"));
        space.crank();
        assertThat(log).containsExactly("made", "made");
        space.close();
    }

    /** Its first instance throws in {@code stopped()}. */
    public static class Clumsy extends Actor {
        private final int number;

        Clumsy(int number) {
            this.number = number;
        }

        public void fail() {
            throw new IllegalStateException("failed");
        }

        @Override
        protected void stopped() {
            if (number == 1) {
                throw new IllegalStateException("the first one cannot even stop");
            }
        }
    }

    @Test
    void restart_stoppedOfTheOldInstanceThrows_freshInstanceIsKept() {
        var space = ActorSpace.create(quiet().withOnError((where, error) -> log.add(where)));
        var made = new AtomicInteger();
        Clumsy clumsy = space.spawn(
                Clumsy.class,
                () -> new Clumsy(made.incrementAndGet()),
                ActorSettings.DEFAULT.withSupervision(Supervision.restart(5, Duration.ofSeconds(1))));
        clumsy.fail();
        space.crank();
        assertThat(made).hasValue(2);
        space.close();
    }

    @Test
    void close_waitingCallWhoseArgumentHasNoText_turnsEverythingAway() {
        var letters = new ArrayList<DeadLetter>();
        var space = ActorSpace.create(quiet().withOnDeadLetter(letters::add).withOnError((where, error) -> {}));
        Worker worker = space.spawn(Worker.class, () -> new Steady(log));
        space.execute(() -> {
            space.close();
            worker.take(new Sourpuss());
            worker.take("fine");
        });
        space.crank();
        Leftovers left = space.close(Duration.ofSeconds(1));
        assertThat(left.messages()).isEqualTo(2);
        assertThat(letters).hasSize(2);
    }

    @Test
    void timeout_argumentHasNoText_stillComes() {
        var clock = new ManualClock();
        var space = ActorSpace.create(quiet().withClock(clock).withOnError((where, error) -> {}));
        Waiting waiting = space.spawn(Waiting.class, () -> anything -> new io.troupe.actor.promise.Deferred<>());
        Promise<Integer> limited = waiting.ask(new Sourpuss()).orTimeout(Duration.ofSeconds(1));
        space.crank();
        clock.advance(Duration.ofSeconds(2));
        space.crank();
        assertThat(limited.error()).isInstanceOf(TimeoutException.class);
        space.close();
    }

    /** Never answers. */
    public interface Waiting {
        Promise<Integer> ask(Object anything);
    }

    @Test
    void close_deadLetterHandlerThrowsAnError_turnsEverythingAway() {
        var letters = new ArrayList<DeadLetter>();
        var space = ActorSpace.create(quiet().withOnError((where, error) -> {}).withOnDeadLetter(letter -> {
            letters.add(letter);
            throw new AssertionError("no dead letters in this test");
        }));
        space.execute(() -> {
            space.close();
            space.execute(() -> log.add("never"));
            space.execute(() -> log.add("never"));
        });
        space.crank();
        Leftovers left = space.close(Duration.ofSeconds(1));
        assertThat(left.tasks()).isEqualTo(2);
        assertThat(letters).hasSize(2);
    }
}
