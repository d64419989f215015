package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.MailboxBound.Overflow;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.actor.time.Timer;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CancellationException;
import java.util.concurrent.CountDownLatch;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Promises, callbacks and calls whose actor or space ends first: none is lost, and no caller waits for ever. */
class EndOfThingsTest {
    private final TestSpace test = new TestSpace();
    private final List<String> log = new ArrayList<>();
    private Promise<?> loop = Promise.done();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    /** Has a method for every kind of call. */
    public static class Worker extends Actor {
        private final EndOfThingsTest outer;

        Worker(EndOfThingsTest outer) {
            this.outer = outer;
        }

        public void failAfterAskingForACallback() {
            Promise.done().thenRun(() -> outer.log.add("callback of the failed instance"));
            throw new IllegalStateException("failed");
        }

        public void stopAfterAskingForACallback() {
            Promise.done().thenRun(() -> outer.log.add("callback of the stopped actor"));
            stop();
        }

        public void loop(Promise<?> step) {
            outer.loop = repeatWhile(() -> true, () -> step);
        }

        public void listenTo(Promise<String> promise) {
            promise.thenAccept(value -> outer.log.add("heard " + value));
        }

        public void stream(Callback<Integer> results) {}

        public Promise<Integer> streamAndAnswer(Callback<Integer> results) {
            return Promise.of(1);
        }

        public void end() {
            stop();
        }

        public Promise<Timer> setTimer() {
            return Promise.of(after(Duration.ofHours(1), () -> {}));
        }

        public void setTimers(int number) {
            every(Duration.ofSeconds(1), () -> {});
            for (int timer = 0; timer < number; timer++) {
                after(Duration.ofHours(1), () -> {});
            }
        }

        @Override
        protected void started() {
            outer.log.add("started");
        }
    }

    private Worker spawn(ActorSettings settings) {
        Worker worker = test.space().spawn(Worker.class, () -> new Worker(this), settings);
        test.crank();
        return worker;
    }

    @Test
    void restart_comesBeforeTheCallbacksThatWait() {
        Worker worker = spawn(ActorSettings.DEFAULT.withSupervision(Supervision.restart(3, Duration.ofSeconds(1))));
        worker.failAfterAskingForACallback();
        test.crank();
        assertThat(log).containsExactly("started", "started");
        assertThat(test.takeProblems()).hasSize(1);
    }

    @Test
    void stop_comesBeforeTheCallbacksThatWait() {
        Worker worker = spawn(ActorSettings.DEFAULT);
        worker.stopAfterAskingForACallback();
        test.crank();
        assertThat(log).containsExactly("started");
    }

    @Test
    void loop_ofAnActorThatStops_endsAtItsNextRound() {
        Worker worker = spawn(ActorSettings.DEFAULT);
        var step = new Deferred<Integer>(test.space());
        worker.loop(step);
        test.crank();
        worker.end();
        test.crank();
        step.resolve(1);
        assertThat(test.error(loop)).isInstanceOf(CancellationException.class);
    }

    @Test
    void rejection_whoseOnlyListenerHasStopped_isReported() {
        Worker worker = spawn(ActorSettings.DEFAULT);
        var source = new Deferred<String>(test.space());
        worker.listenTo(source);
        test.crank();
        worker.end();
        test.crank();
        source.reject(new IllegalStateException("nobody is left"));
        test.crank();
        assertThat(test.takeProblems())
                .extracting(problem -> problem.error().getMessage())
                .containsExactly("nobody is left");
    }

    @Test
    void callback_givenToAnActorThatHasStopped_isFailed() {
        Worker worker = spawn(ActorSettings.DEFAULT);
        worker.end();
        test.crank();
        worker.stream((result, error) -> log.add("stream: " + error));
        Promise<Integer> answer = worker.streamAndAnswer((result, error) -> log.add("request: " + error));
        assertThat(test.error(answer)).isInstanceOf(ActorStoppedException.class);
        assertThat(log).hasSize(3);
        assertThat(log.get(1)).contains("stream: ", "ActorStoppedException", "was not begun");
        assertThat(log.get(2)).contains("request: ", "ActorStoppedException", "was not begun");
        assertThat(test.takeDeadLetters()).hasSize(1);
    }

    @Test
    void callback_ofACallThatAFullMailboxRejectsOrACancelSkips_isFailed() {
        Worker worker = spawn(ActorSettings.DEFAULT.withMailbox(1, Overflow.REJECT));
        Promise<Integer> taken = worker.streamAndAnswer((result, error) -> log.add("first: " + error));
        worker.stream((result, error) -> log.add("second: " + error));
        taken.cancel();
        test.crank();
        assertThat(log).hasSize(3);
        assertThat(log.get(1))
                .contains("second: ", "MailboxFullException"); // a callback: it does not wait for messages
        assertThat(log.get(2)).contains("first: ", "CancellationException", "before it began");
        assertThat(test.takeDeadLetters()).hasSize(1);
    }

    @Test
    void delayAndTimeLimit_inASpaceThatIsClosed_areEnded() {
        var space = ActorSpace.create(SpaceSettings.named("short-lived").withHandCrank());
        Promise<@Nullable Void> delay = space.delay(Duration.ofHours(1));
        Promise<String> limited = new Deferred<String>(space).orTimeout(Duration.ofHours(1));
        delay.exceptionally(error -> null);
        limited.exceptionally(error -> "");
        space.crank();
        Leftovers leftovers = space.close(Duration.ofSeconds(1));
        assertThat(leftovers.timers()).isEqualTo(2);
        assertThat(leftovers.isEmpty()).isTrue();
        assertThat(delay.error()).isInstanceOf(CancellationException.class).hasMessageContaining("PT1H");
        assertThat(limited.error()).isInstanceOf(CancellationException.class).hasMessageContaining("was closed before");
        assertThat(space.delay(Duration.ofSeconds(1)).error()).isInstanceOf(CancellationException.class);
    }

    @Test
    void close_reportsWhatWasStillQueued() {
        var letters = new ArrayList<DeadLetter>();
        var space = ActorSpace.create(SpaceSettings.named("left")
                .withOnDeadLetter(letters::add)
                .withOnError((where, error) -> {})
                .withHandCrank());
        Worker worker = space.spawn(Worker.class, () -> new Worker(this), ActorSettings.named("worker"));
        var request = new ArrayList<Promise<Integer>>();
        space.crank();
        space.execute(() -> {
            space.close(); // the calls below are queued behind it
            worker.end();
            request.add(worker.streamAndAnswer((result, error) -> {}));
        });
        space.crank();
        Leftovers leftovers = space.close(Duration.ofSeconds(1));
        assertThat(leftovers.messages()).isEqualTo(1);
        assertThat(leftovers.requests()).isEqualTo(1);
        assertThat(leftovers.examples().getFirst()).isEqualTo("Worker.end() to worker");
        assertThat(leftovers.examples().get(1))
                .startsWith("Worker.streamAndAnswer(")
                .endsWith(" of worker");
        assertThat(letters).hasSize(1);
        assertThat(request.getFirst().error()).isInstanceOf(ActorStoppedException.class);
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void close_ofASpaceThatIsBusy_reportsWithWhat() throws Exception {
        var begun = new CountDownLatch(1);
        var goOn = new CountDownLatch(1);
        var space = ActorSpace.create(SpaceSettings.named("busy").withOnStall(Duration.ZERO, stall -> {}));
        space.execute(() -> {
            begun.countDown();
            try {
                goOn.await();
            } catch (InterruptedException e) {
                throw new IllegalStateException(e);
            }
        });
        begun.await();
        assertThatThrownBy(() -> space.close(Duration.ofMillis(1)))
                .isInstanceOf(ActorException.class)
                .hasMessageContainingAll("space busy did not end within PT0.001S", "busy at ");
        goOn.countDown();
        assertThat(space.close(Duration.ofSeconds(30)).isEmpty()).isTrue();
    }

    @Test
    void timers_ofAnActorThatStops_leaveTheWheelAtOnce() {
        Worker worker = spawn(ActorSettings.DEFAULT);
        worker.setTimers(20);
        test.crank();
        assertThat(test.space().metrics().timers()).isEqualTo(21);
        worker.end();
        test.crank();
        assertThat(test.space().metrics().timers()).isZero();
    }

    @Test
    void timer_cancelledOnAnotherThread_throwsAndNamesTheThread() {
        Worker worker = spawn(ActorSettings.DEFAULT);
        var timer = test.get(worker.setTimer());
        assertThatThrownBy(timer::cancel)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("on the thread of its space only");
        test.run(() -> assertThat(timer.cancel()).isTrue());
    }

    @Test
    void loop_whosePromiseIsCancelled_ends() {
        var rounds = new int[1];
        test.run(() -> {
            Promise<?> loop = test.space().repeatWhile(() -> rounds[0] < 1000, () -> {
                rounds[0]++;
            });
            test.space().execute(loop::cancel);
        });
        assertThat(rounds[0]).isLessThan(1000);
    }

    @Test
    void race_ofNothing_isRejected() {
        assertThat(Promise.race(List.<Promise<Integer>>of()).error()).hasMessage("race of no promises");
    }

    @Test
    void dropOldest_keepsNoMoreThanItsCapacityQueued() {
        Worker worker = spawn(ActorSettings.DEFAULT.withMailbox(3, Overflow.DROP_OLDEST));
        for (int call = 0; call < 1000; call++) {
            worker.stream((result, error) -> {});
        }
        assertThat(test.takeDeadLetters()).hasSize(997);
        assertThat(test.space().metrics().waiting() - 997).isEqualTo(3); // and 997 queued callbacks of rejected calls
        test.crank();
    }
}
