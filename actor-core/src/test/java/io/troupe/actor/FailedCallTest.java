package io.troupe.actor;

import static io.troupe.actor.Concurrently.LONG;
import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.params.provider.Arguments.argumentSet;

import io.troupe.actor.ActorSettings.Overflow;
import java.time.Duration;
import java.time.temporal.ChronoUnit;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CancellationException;
import java.util.concurrent.TimeoutException;
import java.util.function.Supplier;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.Arguments;
import org.junit.jupiter.params.provider.MethodSource;

/** Calls that fail, that no actor handles, or that are not answered in time; and user code of the space that throws. */
@Timeout(60)
class FailedCallTest extends InTestSpace {
    private static final Duration SECOND = Duration.ofSeconds(1);

    interface Counter {
        Promise<Integer> add(int amount);

        default void fail(String why) {
            throw new IllegalArgumentException(why);
        }

        default Promise<Integer> failing(String why) {
            throw new IllegalArgumentException(why);
        }
    }

    private static Counter failingCounter() {
        var sum = new int[1];
        return amount -> Promise.of(sum[0] += amount);
    }

    private final Counter counter = test.spawn(Counter.class, FailedCallTest::failingCounter);

    private void assertReported(String where, String message) {
        assertThat(test.takeProblems()).singleElement().satisfies(problem -> {
            assertThat(problem.where()).isEqualTo(where);
            assertThat(problem.error()).hasMessage(message);
        });
    }

    @Test
    void exception_inARequest_rejectsItsPromiseUnwrapped_beforeAnyTimeHasPassed() {
        for (var request :
                List.of(counter.failing("why"), counter.failing("why").orTimeout(Duration.ofSeconds(30)))) {
            assertThat(test.error(request))
                    .isExactlyInstanceOf(IllegalArgumentException.class)
                    .hasMessage("why");
        }
        assertThat(test.clock().nanos()).isZero();
    }

    @Test
    void exception_inAOneWayMessage_goesToTheErrorHandler() {
        counter.fail("on purpose");
        test.runQueued();
        assertReported("Counter.fail(String) of Counter#1", "on purpose");
        assertThat(test.get(counter.add(2))).isEqualTo(2);
    }

    @Test
    void exception_goesToTheActorsOwnHandlerFirst() {
        var settings =
                ActorSettings.named("tally").withOnError((where, error) -> log.add(where + ": " + error.getMessage()));
        test.spawn(Counter.class, FailedCallTest::failingCounter, settings).fail("mine");
        test.runQueued();
        assertThat(log).containsExactly("Counter.fail(String) of tally: mine");
    }

    @Test
    void requestThatAnswersNull_isRejectedByName() {
        interface Careless {
            Promise<String> ask();
        }
        Careless careless = test.spawn(Careless.class, () -> () -> null);
        assertThat(test.error(careless.ask()))
                .hasMessage("Careless.ask() of Careless#2 returned null, expected a promise");
    }

    @Test
    void rejection_withoutAListener_isReported_fromOutsideAfterAMoment() {
        test.run(() -> counter.failing("unheard"));
        assertReported("a rejected promise without a listener: Counter.failing(String) of Counter#1", "unheard");
        counter.failing("unheard");
        test.runQueued();
        assertThat(test.takeProblems()).isEmpty();
        test.advance(SECOND);
        assertThat(test.takeProblems()).hasSize(1);
    }

    /** In the form of the paper, and in that of CompletableFuture; a {@code finally} does not see the error. */
    @Test
    void error_thatAListenerWasGiven_isNotReported() {
        var heard = new ArrayList<String>();
        test.run(() -> {
            counter.failing("one").then((value, error) -> heard.add(error.getMessage()));
            counter.failing("two").whenComplete((value, error) -> heard.add(error.getMessage()));
            counter.failing("three").handle((value, error) -> heard.add(error.getMessage()));
        });
        counter.failing("four").whenComplete((value, error) -> heard.add(error.getMessage()));
        test.advance(SECOND);
        assertThat(heard).containsExactlyInAnyOrder("one", "two", "three", "four");
        assertThat(test.takeProblems()).isEmpty();
        test.run(() -> counter.failing("unseen").eventually(() -> heard.add("at the end")));
        assertThat(takeErrors()).containsExactly("unseen");
    }

    @Test
    void factory_thatThrows_isReportedAndItsActorIsStopped() {
        Counter never = test.spawn(Counter.class, () -> {
            throw new IllegalStateException("no counter today");
        });
        assertThat(test.error(never.add(1))).isInstanceOf(ActorStoppedException.class);
        assertThat(takeErrors()).containsExactly("no counter today");
    }

    @Test
    void stoppedActor_rejectsRequestsAndMakesDeadLettersOfMessages() {
        test.space().stop(counter);
        assertThat(test.error(counter.add(1)))
                .isInstanceOf(ActorStoppedException.class)
                .hasMessage("Counter.add(int) of Counter#1 was not begun: the actor Counter#1 has stopped");
        counter.fail("into the void");
        test.runQueued();
        assertThat(test.takeDeadLetters())
                .containsExactly(new DeadLetter(
                        "Counter#1",
                        "Counter.fail(String)",
                        List.of("into the void"),
                        "the actor Counter#1 has stopped"));
    }

    @Test
    void cancel_reachesARequestThatWaits() {
        counter.add(1);
        Promise<Integer> cancelled = counter.add(10);
        assertThat(cancelled.cancel()).isTrue();
        assertThat(test.get(counter.add(2))).isEqualTo(3);
        assertThat(cancelled.isCancelled()).isTrue();
        assertThat(test.error(cancelled))
                .isInstanceOf(CancellationException.class)
                .hasMessageContaining("Counter.add(int) of Counter#1 was cancelled");
    }

    // ---- time limits

    interface Worker {
        Promise<Integer> ask(Object anything);
    }

    private void logTimeout(Promise<Integer> request) {
        request.orTimeout(Duration.ZERO).exceptionally(late -> log.add(late.getMessage()) ? 0 : 1);
    }

    @Test
    void timeout_ofARequestThatTookTheOldestOnesPlace_reportsThatItHasNotBegun() {
        var one = ActorSettings.defaults().withMailbox(1, Overflow.DROP_OLDEST);
        Worker worker = test.spawn(Worker.class, () -> number -> new Deferred<>(), one);
        test.run(() -> {
            for (int before = 0; before < 600; before++) {
                test.space().execute(() -> {}); // more than one pass runs
            }
            worker.ask(1).exceptionally(dropped -> 0);
            logTimeout(worker.ask(2));
        });
        assertThat(log).singleElement().asString().contains("which has not begun it");
    }

    interface Switch {
        Promise<Integer> press(int times, Callback<String> clicks);
    }

    /** Asks while more is queued than one pass runs, so that a time limit of zero passes first. */
    private void askLate(Runnable question) {
        test.run(() -> {
            for (int before = 0; before < 600; before++) {
                test.space().execute(() -> {});
            }
            question.run();
        });
    }

    @Test
    void request_whoseCallersHaveTimedOut_isNotBegun_andItsCallbacksEnd() {
        Switch actor = test.spawn(Switch.class, () -> (times, clicks) -> {
            log.add("pressed");
            return Promise.of(times);
        });
        askLate(() -> {
            var request = actor.press(1, (click, error) -> log.add("callback: " + error));
            logTimeout(request);
            logTimeout(request);
            request.orTimeout(Duration.ofDays(1)).cancel();
        });
        assertThat(log).hasSize(3);
        assertThat(log.subList(0, 2)).allMatch(line -> line.startsWith("no answer to"));
        assertThat(log.get(2))
                .startsWith("callback: ")
                .contains("Switch.press(int, Callback)", "was cancelled or given up");
    }

    @Test
    void request_thatOneCallerHasGivenUp_isBegunForTheOther_orIfNobodyListens() {
        Switch actor = test.spawn(Switch.class, () -> (times, clicks) -> {
            log.add("pressed " + times);
            return Promise.of(times);
        });
        askLate(() -> {
            var request = actor.press(1, (click, error) -> {});
            logTimeout(request);
            request.then(times -> log.add("answered " + times));
            actor.press(2, (click, error) -> {});
        });
        assertThat(log.subList(1, log.size())).containsExactly("pressed 1", "answered 1", "pressed 2");
    }

    @Test
    void request_thatHasBegun_isNotSkippedWhenItsCallerTimesOut() {
        var answer = new Deferred<Integer>();
        Worker worker = test.spawn(Worker.class, () -> anything -> answer);
        Promise<Integer> request = worker.ask(1);
        test.runQueued();
        test.run(() -> logTimeout(request));
        test.run(() -> answer.resolve(7));
        assertThat(test.get(request)).isEqualTo(7);
    }

    @Test
    void timeout_behindALongQueue_countsItNoFurtherThanAThousand() {
        Worker worker = test.spawn(Worker.class, () -> number -> new Deferred<>());
        test.run(() -> {
            for (int before = 0; before < 3_000; before++) {
                worker.ask(before);
            }
            logTimeout(worker.ask(1));
        });
        String end = "from Worker.ask(Object) of Worker#2, where more than 1000 calls wait";
        assertThat(log).singleElement().asString().endsWith(end);
    }

    static final class Sourpuss {
        @Override
        public String toString() {
            throw new StackOverflowError("a list that contains itself has no text");
        }
    }

    private final ManualClock clock = new ManualClock();

    private ActorSpace space(ErrorHandler handler) {
        return ActorSpace.create(
                SpaceSettings.named("handlers").withClock(clock).withoutThread().withOnError(handler));
    }

    @Test
    void timeout_argumentHasNoText_stillComes() {
        var space = space((where, error) -> {});
        Worker worker = space.spawn(Worker.class, () -> anything -> new Deferred<>());
        Promise<Integer> limited = worker.ask(new Sourpuss()).orTimeout(SECOND);
        space.runQueued();
        clock.advance(SECOND.multipliedBy(2));
        space.runQueued();
        assertThat(limited.error()).isInstanceOf(TimeoutException.class);
        space.close();
    }

    // ---- handlers and texts that throw

    private static final class Unspeakable extends RuntimeException {
        private static final long serialVersionUID = 1;

        @Override
        public String getMessage() {
            throw new IllegalStateException("this error's text cannot be made");
        }
    }

    private static void rethrow(String where, Throwable error) {
        throw (RuntimeException) error;
    }

    @Test
    void errorHandler_throwsWhatItWasGiven_spaceGoesOn() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("rethrowing").withOnError(FailedCallTest::rethrow))) {
            Counter failing = space.spawn(Counter.class, FailedCallTest::failingCounter);
            failing.fail("failed");
            assertThat(failing.add(1).get(LONG)).isEqualTo(1);
        }
    }

    static List<Arguments> failures() {
        ErrorHandler quiet = (where, error) -> {};
        ErrorHandler rethrowing = FailedCallTest::rethrow;
        var failure = new IllegalStateException("failed");
        return List.of(
                argumentSet("whose handler throws what it was given", rethrowing, failure, SECOND),
                argumentSet("whose text throws", quiet, new Unspeakable(), SECOND),
                argumentSet("in a window for ever", quiet, failure, ChronoUnit.FOREVER.getDuration()));
    }

    private void assertRestarted(ActorSpace space, Supplier<Doer> factory, RuntimeException failure, Duration window) {
        Supplier<Doer> logged = () -> {
            log.add("made");
            return factory.get();
        };
        var settings = ActorSettings.defaults().withSupervision(Supervision.restart(3, window));
        space.spawn(Doer.class, logged, settings).run(me -> {
            throw failure;
        });
        space.runQueued();
        assertThat(log).containsExactly("made", "made");
        space.close();
    }

    @ParameterizedTest
    @MethodSource("failures")
    void supervision_ofAFailure_stillRestarts(ErrorHandler handler, RuntimeException failure, Duration window) {
        assertRestarted(space(handler), Doer::new, failure, window);
    }

    @Test
    void restart_stoppedOfTheOldInstanceThrows_freshInstanceIsKept() {
        class Clumsy extends Doer {
            private final boolean isFirst = log.size() == 1;

            @Override
            protected void stopped() {
                if (isFirst) {
                    throw new IllegalStateException("the first one cannot even stop");
                }
            }
        }
        assertRestarted(space((where, error) -> {}), Clumsy::new, new IllegalStateException("failed"), SECOND);
    }
}
