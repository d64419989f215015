package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.ArrayList;
import java.util.concurrent.CancellationException;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** Calls that fail, or that no actor handles. */
class FailedCallTest {
    interface Counter {
        Promise<Integer> add(int amount);

        void fail(String why);

        Promise<Integer> failing(String why);
    }

    private static final class FailingCounter implements Counter {
        private int sum;

        @Override
        public Promise<Integer> add(int amount) {
            sum += amount;
            return Promise.of(sum);
        }

        @Override
        public void fail(String why) {
            throw new IllegalArgumentException(why);
        }

        @Override
        public Promise<Integer> failing(String why) {
            throw new IllegalArgumentException(why);
        }
    }

    private final TestSpace test = new TestSpace();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    @Test
    void exception_inARequest_rejectsItsPromiseUnwrapped() {
        Counter counter = test.spawn(Counter.class, FailingCounter::new);
        Throwable error = test.error(counter.failing("no reason"));
        assertThat(error).isExactlyInstanceOf(IllegalArgumentException.class).hasMessage("no reason");
    }

    @Test
    void exception_inAOneWayMessage_goesToTheErrorHandler() {
        Counter counter = test.spawn(Counter.class, FailingCounter::new);
        counter.fail("on purpose");
        test.crank();
        assertThat(test.takeProblems()).singleElement().satisfies(problem -> {
            assertThat(problem.where()).isEqualTo("Counter.fail(String) of Counter#1");
            assertThat(problem.error()).hasMessage("on purpose");
        });
        assertThat(test.get(counter.add(2))).isEqualTo(2);
    }

    @Test
    void exception_goesToTheActorsOwnHandlerFirst() {
        var own = new ArrayList<String>();
        Counter counter = test.space()
                .spawn(
                        Counter.class,
                        FailingCounter::new,
                        ActorSettings.named("tally")
                                .withOnError((where, error) -> own.add(where + ": " + error.getMessage())));
        counter.fail("mine");
        test.crank();
        assertThat(own).containsExactly("Counter.fail(String) of tally: mine");
    }

    @Test
    void requestThatAnswersNull_isRejectedByName() {
        interface Careless {
            Promise<String> ask();
        }
        Careless careless = test.spawn(Careless.class, () -> () -> null);
        assertThat(test.error(careless.ask()))
                .hasMessage("Careless.ask() of Careless#1 answered null, expected a promise");
    }

    @Test
    void rejection_withoutAListener_isReported() {
        Counter counter = test.spawn(Counter.class, FailingCounter::new);
        test.run(() -> counter.failing("unheard"));
        assertThat(test.takeProblems()).singleElement().satisfies(problem -> {
            assertThat(problem.where()).isEqualTo("a promise nobody listens to: Counter.failing(unheard) of Counter#1");
            assertThat(problem.error()).hasMessage("unheard");
        });
    }

    @Test
    void rejection_askedFromOutside_isReportedAfterAMoment() {
        Counter counter = test.spawn(Counter.class, FailingCounter::new);
        counter.failing("unheard");
        test.crank();
        assertThat(test.takeProblems()).isEmpty();
        test.advance(Duration.ofSeconds(1));
        assertThat(test.takeProblems()).hasSize(1);
    }

    @Test
    void factory_thatThrows_isReportedAndItsActorIsStopped() {
        Counter counter = test.space().spawn(Counter.class, () -> {
            throw new IllegalStateException("no counter today");
        });
        assertThat(test.error(counter.add(1))).isInstanceOf(ActorStoppedException.class);
        assertThat(test.takeProblems())
                .singleElement()
                .satisfies(problem -> assertThat(problem.error()).hasMessage("no counter today"));
    }

    @Test
    void stoppedActor_rejectsRequestsAndMakesDeadLettersOfMessages() {
        Counter counter = test.spawn(Counter.class, FailingCounter::new);
        test.space().stop(counter);
        Throwable error = test.error(counter.add(1));
        assertThat(error)
                .isInstanceOf(ActorStoppedException.class)
                .hasMessage("Counter.add(1) of Counter#1 was not begun: the actor Counter#1 has stopped");
        counter.fail("into the void");
        test.crank();
        assertThat(test.takeDeadLetters())
                .containsExactly(
                        new DeadLetter("Counter#1", "Counter.fail(into the void)", "the actor Counter#1 has stopped"));
    }

    @Test
    void cancel_reachesARequestThatWaits() {
        Counter counter = test.spawn(Counter.class, FailingCounter::new);
        counter.add(1);
        Promise<Integer> cancelled = counter.add(10);
        assertThat(cancelled.cancel()).isTrue();
        assertThat(test.get(counter.add(2))).isEqualTo(3);
        assertThat(cancelled.isCancelled()).isTrue();
        assertThat(test.error(cancelled))
                .isInstanceOf(CancellationException.class)
                .hasMessageContaining("Counter.add(10)");
    }
}
