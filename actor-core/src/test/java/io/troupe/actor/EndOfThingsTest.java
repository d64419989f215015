package io.troupe.actor;

import static io.troupe.actor.Concurrently.LONG;
import static io.troupe.actor.Concurrently.await;
import static io.troupe.actor.Concurrently.onAnotherThread;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSettings.Overflow;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CancellationException;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Promises, timers and calls whose actor or space ends first: none is lost, and no caller waits for ever. */
@Timeout(60)
class EndOfThingsTest extends InTestSpace {
    private static final Duration SECOND = Duration.ofSeconds(1);
    private static final Duration HOUR = Duration.ofHours(1);

    // ---- actors

    @Test
    void stopAndRestart_comeBeforeTheCallbacksThatWait() {
        class Starting extends Doer {
            @Override
            protected void started() {
                log.add("started");
            }
        }
        var restarting = ActorSettings.defaults().withSupervision(Supervision.restart(3, SECOND));
        test.spawn(Doer.class, Starting::new, restarting).run(me -> {
            Promise.done().thenRun(() -> log.add("callback of the failed instance"));
            throw new IllegalStateException("failed");
        });
        test.runQueued();
        assertThat(log).containsExactly("started", "started");
        assertThat(test.takeProblems()).hasSize(1);
        test.spawn(Doer.class, Starting::new).run(me -> {
            Promise.done().thenRun(() -> log.add("callback of the stopped actor"));
            me.context().stop();
        });
        test.runQueued();
        assertThat(log).containsExactly("started", "started", "started");
    }

    private final Doer worker = test.spawn(Doer.class, Doer::new);

    @Test
    void loop_ofAnActorThatStops_endsAtItsNextRound() {
        Deferred<Integer> step = test.space().deferred();
        var loop = new AtomicReference<Promise<?>>();
        worker.run(me -> loop.set(me.context().repeatWhile(() -> true, () -> step)));
        test.runQueued();
        stop(worker);
        step.resolve(1);
        assertThat(test.error(loop.get())).isInstanceOf(CancellationException.class);
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
    void rejection_whoseOnlyListenerHasStopped_isReported() {
        Deferred<String> source = test.space().deferred();
        worker.run(me -> source.thenAccept(value -> log.add("heard " + value)));
        test.runQueued();
        stop(worker);
        source.reject(new IllegalStateException("nobody is left"));
        test.runQueued();
        assertThat(takeErrors()).containsExactly("nobody is left");
    }

    @Test
    void timers_ofAnActorThatStops_leaveTheWheelAtOnce() {
        worker.run(me -> {
            me.context().every(SECOND, () -> {});
            me.context().after("once", HOUR, () -> {});
            me.context().every("again", SECOND, () -> {});
            for (int timer = 0; timer < 20; timer++) {
                me.context().after(HOUR, () -> {});
            }
        });
        test.runQueued();
        assertThat(test.space().metrics().timers()).isEqualTo(23);
        stop(worker);
        assertThat(test.space().metrics().timers()).isZero();
    }

    @Test
    void timer_cancelledOnAnotherThread_throwsAndNamesTheThread() {
        var timer = test.get(worker.ask(me -> Promise.of(me.context().after(HOUR, () -> {}))));
        assertThatThrownBy(timer::cancel)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("on the thread of its space only");
        test.run(() -> assertThat(timer.cancel()).isTrue());
    }

    // ---- spaces

    private final List<DeadLetter> letters = new ArrayList<>();
    private final ManualClock clock = new ManualClock();
    private final SpaceSettings settings = SpaceSettings.named("ending")
            .withClock(clock)
            .withOnDeadLetter(letters::add)
            .withOnError((where, error) -> log.add(where))
            .withoutThread();
    private final ActorSpace space = ActorSpace.create(settings);
    private final Doer doer = space.spawn(Doer.class, Doer::new);

    private void runIn(ActorSpace any, Runnable task) {
        any.execute(task);
        any.runQueued();
    }

    interface Desk {
        Promise<String> ask(Object what);
    }

    interface Sink {
        void take(Object what);
    }

    @Test
    void close_callBeforeItsActorHasStarted_isRejected() {
        var made = new AtomicReference<Doer>();
        runIn(space, () -> {
            onAnotherThread(() -> made.set(space.spawn(Doer.class, Doer::new))); // its start is in the inbox
            space.close();
            made.get().run(me -> log.add("took a call"));
        });
        assertThat(log).isEmpty();
        assertThat(letters).hasSize(1);
    }

    @Test
    void close_retryFromOutside_ends() {
        space.execute(space::close);
        Promise<String> retried = space.retry(3, SECOND, () -> doer.ask(me -> new Deferred<>()));
        space.runQueued();
        assertThat(retried.isDone()).isTrue();
    }

    @Test
    void close_lastListener_delaysAreCancelled_andItsErrorIsReported() {
        var late = new AtomicReference<Promise<?>>();
        runIn(space, () -> {
            space.close();
            doer.ask(me -> Promise.of("")).whenComplete((value, tooLate) -> {
                late.set(space.delay(SECOND));
                throw new IllegalStateException("a fault in a listener");
            });
        });
        assertThat(late.get().error()).isInstanceOf(CancellationException.class);
        assertThat(log).hasSize(1);
    }

    @Test
    void close_lastErrorHandlerCallsAnActor_callIsADeadLetter() {
        class Loser extends Actor {
            @Override
            protected void stopped() {
                new Deferred<String>().reject(new IllegalStateException("nobody listens"));
            }
        }
        var logger = new AtomicReference<Doer>();
        var own = ActorSpace.create(
                settings.withOnError((where, error) -> logger.get().run(me -> log.add(where))));
        logger.set(own.spawn(Doer.class, Doer::new));
        own.runQueued();
        own.spawn(Loser.class, Loser::new);
        own.close();
        assertThat(letters).hasSize(1);
    }

    @Test
    void close_idleActionThatWaits_isNotLostInSilence() {
        runIn(space, () -> {
            space.onIdle(() -> log.add("idle"));
            space.close();
            space.execute(() -> {}); // so that it is never idle again, and this is a dead letter
        });
        assertThat(log.size() + letters.size()).isEqualTo(2);
    }

    @Test
    void close_deadLetterHandlerThrowsAnError_turnsEverythingAway_andKeepsTheLeftovers() {
        var own = ActorSpace.create(settings.withOnDeadLetter(letter -> {
            letters.add(letter);
            throw new AssertionError("no dead letters in this test");
        }));
        runIn(own, () -> {
            own.close();
            own.execute(() -> log.add("never"));
            own.execute(() -> log.add("never"));
        });
        assertThat(own.close(SECOND).tasks()).isEqualTo(2);
        own.runQueued();
        assertThat(own.close(SECOND).tasks()).isEqualTo(2);
        assertThat(letters).hasSize(2);
    }

    static class Counter extends Actor {
        public Promise<String> old() {
            return Promise.of("old");
        }

        public Promise<String> newest() {
            return Promise.of("newest");
        }
    }

    @Test
    void close_droppedCallsTicket_leftoversNameTheCallThatWaits() {
        var one = ActorSettings.defaults().withMailbox(1, Overflow.DROP_OLDEST);
        Counter counter = space.spawn(Counter.class, Counter::new, one);
        space.runQueued();
        runIn(space, () -> {
            space.close();
            counter.old().exceptionally(error -> "");
            counter.newest().exceptionally(error -> "");
        });
        Leftovers left = space.close(SECOND);
        assertThat(left.requests()).isEqualTo(1);
        assertThat(left.examples()).containsExactly("Counter.newest() of Counter#2");
    }

    interface Source {
        Promise<Integer> stream(Callback<Integer> results);
    }

    @Test
    void close_reportsWhatWasStillQueued() {
        Sink sink = space.spawn(Sink.class, () -> what -> {}, ActorSettings.named("sink"));
        Source source = space.spawn(Source.class, () -> results -> Promise.of(1), ActorSettings.named("source"));
        var request = new AtomicReference<Promise<Integer>>();
        space.runQueued();
        runIn(space, () -> {
            space.close(); // the calls below are queued behind it
            sink.take("x".repeat(81)); // longer than the text of an argument may be
            request.set(source.stream((result, error) -> {}));
        });
        Leftovers leftovers = space.close(SECOND);
        assertThat(leftovers.messages()).isEqualTo(1);
        assertThat(leftovers.requests()).isEqualTo(1);
        assertThat(leftovers.examples())
                .satisfiesExactly(
                        first -> assertThat(first).isEqualTo("Sink.take(Object) to sink"),
                        second ->
                                assertThat(second).startsWith("Source.stream(").endsWith(" of source"));
        assertThat(letters).hasSize(1);
        assertThat(request.get().error()).isInstanceOf(ActorStoppedException.class);
    }

    @Test
    void close_waitingCallWhoseArgumentHasNoText_turnsEverythingAway() {
        Sink sink = space.spawn(Sink.class, () -> what -> {});
        runIn(space, () -> {
            space.close();
            sink.take(new FailedCallTest.Sourpuss());
            sink.take("fine");
        });
        assertThat(space.close(SECOND).messages()).isEqualTo(2);
        assertThat(letters).hasSize(2);
    }

    @Test
    void delayAndTimeLimit_inASpaceThatIsClosed_areEnded() {
        Promise<@Nullable Void> delay = space.delay(HOUR);
        Promise<String> limited = space.<String>deferred().orTimeout(HOUR);
        delay.exceptionally(error -> null);
        limited.exceptionally(error -> "");
        space.runQueued();
        Leftovers leftovers = space.close(SECOND);
        assertThat(leftovers.timers()).isEqualTo(2);
        assertThat(leftovers.isEmpty()).isTrue();
        assertThat(delay.error()).isInstanceOf(CancellationException.class).hasMessageContaining("PT1H");
        assertThat(limited.error()).isInstanceOf(CancellationException.class).hasMessageContaining("was closed before");
        assertThat(space.delay(SECOND).error()).isInstanceOf(CancellationException.class);
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void close_ofASpaceThatIsBusy_reportsWithWhat() {
        var begun = new CountDownLatch(1);
        var goOn = new CountDownLatch(1);
        var busy = ActorSpace.create(SpaceSettings.named("busy").withoutStallLimit());
        busy.execute(() -> {
            begun.countDown();
            await(goOn);
        });
        await(begun);
        assertThatThrownBy(() -> busy.close(Duration.ofMillis(1)))
                .isInstanceOf(ActorException.class)
                .hasMessageContainingAll("space busy did not end within PT0.001S", "busy at ");
        goOn.countDown();
        assertThat(busy.close(LONG).isEmpty()).isTrue();
    }

    @Test
    void deadLetterHandler_listenerItRegisters_isNotThatOfTheActorWhoseTurnWasBefore() {
        var own = new AtomicReference<ActorSpace>();
        own.set(ActorSpace.create(
                settings.withOnDeadLetter(letter -> own.get().delay(SECOND).thenRun(() -> log.add("alarm")))));
        Doer stopped = own.get().spawn(Doer.class, Doer::new);
        own.get().stop(stopped);
        own.get().runQueued();
        Doer other = own.get().spawn(Doer.class, Doer::new);
        other.run(me -> log.add("took a call"));
        stopped.run(me -> log.add("never"));
        own.get().runQueued();
        own.get().stop(other);
        own.get().runQueued();
        clock.advance(SECOND.multipliedBy(2));
        own.get().runQueued();
        assertThat(log).containsExactly("took a call", "alarm");
        own.get().close();
    }
}
