package io.troupe.actor;

import static io.troupe.actor.Concurrently.await;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CancellationException;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicInteger;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.parallel.Isolated;

/** The services of a space: delays, retries, loops, blocking work, sequential bodies, time limits set outside. */
@Isolated("looks at all threads")
class SpaceServicesTest extends InTestSpace {
    private static final Duration SECOND = Duration.ofSeconds(1);
    private static final Duration SOON = Duration.ofMillis(10);
    private static final Duration LONG = Duration.ofHours(1);
    private static final Duration PATIENCE = Duration.ofSeconds(50);

    private final Deferred<String> pending = test.space().deferred();

    @Test
    void delay_followsTheSpacesClock() {
        Promise<?> delay = test.space().delay(Duration.ofSeconds(2));
        test.advance(Duration.ofMillis(1_999));
        assertThat(delay.isDone()).isFalse();
        test.advance(Duration.ofMillis(1));
        assertThat(delay.isDone()).isTrue();
    }

    @Test
    void retry_pausesBetweenItsTries_andAnswersTheFirstValue() {
        var tries = new int[1];
        test.run(() -> test.space()
                .retry(5, SECOND, () -> {
                    log.add("try " + ++tries[0] + " at " + test.clock().nanos() / 1_000_000_000);
                    return tries[0] < 3 ? Promise.<String>failed(new IOException("not yet")) : Promise.of("done");
                })
                .thenAccept(log::add));
        test.advance(SECOND);
        test.advance(SECOND);
        assertThat(log).containsExactly("try 1 at 0", "try 2 at 1", "try 3 at 2", "done");
    }

    @Test
    void retry_answersTheLastError_alsoOfAnAttemptThatThrows() {
        var tries = new int[1];
        test.run(() -> test.space()
                .<String>retry(2, SECOND, () -> {
                    throw new IllegalStateException("failure " + ++tries[0]);
                })
                .handle((value, error) -> log.add("ended with " + error)));
        test.advance(SECOND);
        assertThat(log).containsExactly("ended with java.lang.IllegalStateException: failure 2");
        assertThatThrownBy(() -> test.space().retry(0, Duration.ZERO, () -> Promise.of(1)))
                .hasMessageContaining("tries is 0");
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void offload_runsBlockingWorkElsewhere_andItsListenerHere() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("busy"))) {
            var where = new Deferred<String>();
            space.execute(() -> space.offload(() -> Thread.currentThread().isVirtual())
                    .then(virtual -> where.resolve(virtual + " then " + threadName())));
            assertThat(where.get(Duration.ofSeconds(30))).isEqualTo("true then busy");
            Promise<String> failing = space.offload(() -> {
                throw new IOException("disk");
            });
            assertThatThrownBy(() -> failing.get(Duration.ofSeconds(30)))
                    .isInstanceOf(IOException.class)
                    .hasMessage("disk");
        }
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void offloadThatIsCancelled_isInterrupted_whetherItHasBegunOrWaits() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("busy").withOffloadLimit(1))) {
            var begun = new CountDownLatch(1);
            var interrupted = new CountDownLatch(1);
            var ran = new AtomicBoolean();
            Promise<String> blocked = space.offload(() -> {
                begun.countDown();
                try {
                    new CountDownLatch(1).await();
                } catch (InterruptedException cancelled) {
                    interrupted.countDown();
                }
                return "";
            });
            begun.await();
            Promise<Boolean> waiting = space.offload(() -> ran.getAndSet(true));
            waiting.cancel();
            blocked.cancel();
            interrupted.await();
            assertThat(space.offload(() -> "free").get(Duration.ofSeconds(30))).isEqualTo("free");
            assertThat(ran).isFalse();
        }
    }

    private static String threadName() {
        return Thread.currentThread().getName();
    }

    @Test
    @SuppressWarnings("NullAway") // passes null on purpose
    void nullArgument_isRejectedAtOnce_byName() {
        ActorSpace space = test.space();
        assertThatThrownBy(() -> space.delay(null)).hasMessage("duration");
        assertThatThrownBy(() -> space.retry(1, null, () -> Promise.of(1))).hasMessage("pause");
        assertThatThrownBy(() -> space.retry(1, Duration.ZERO, null)).hasMessage("attempt");
        assertThatThrownBy(() -> space.whenStopped(null)).hasMessage("proxy");
        test.run(() -> {
            assertThatThrownBy(() -> space.repeatWhile(() -> false, (Runnable) null))
                    .hasMessage("body");
            log.add("checked");
        });
        assertThat(log).containsExactly("checked");
    }

    // ---- repeatWhile

    @Test
    void repeatWhile_sharesTheThreadBetweenRounds() {
        test.run(() -> {
            countDown("a", 3);
            countDown("b", 2);
        });
        assertThat(log).containsExactly("a3", "b2", "a2", "b1", "a1");
    }

    private void countDown(String name, int from) {
        var left = new int[] {from};
        test.space().repeatWhile(() -> left[0] > 0, () -> {
            log.add(name + left[0]--);
        });
    }

    @Test
    void repeatWhile_waitsForThePromiseOfItsBody() {
        var steps = new ArrayList<Deferred<String>>();
        test.run(() -> test.space()
                .repeatWhile(() -> steps.size() < 2, () -> {
                    steps.add(new Deferred<>());
                    return steps.getLast();
                })
                .thenRun(() -> log.add("over")));
        assertThat(steps).hasSize(1);
        steps.getFirst().resolve("first");
        test.runQueued();
        assertThat(steps).hasSize(2);
        assertThat(log).isEmpty();
        steps.getLast().resolve("second");
        test.runQueued();
        assertThat(log).containsExactly("over");
    }

    @Test
    void repeatWhile_thatThrows_rejectsItsPromise() {
        test.run(() -> test.space()
                .repeatWhile(() -> true, () -> {
                    throw new IllegalStateException("third time unlucky");
                })
                .handle((value, error) -> log.add("ended with " + error)));
        assertThat(log).containsExactly("ended with java.lang.IllegalStateException: third time unlucky");
    }

    @Test
    void repeatWhile_ofABodyThatReturnsNoPromise_isRejected() {
        var rounds = new AtomicInteger();
        test.run(() -> test.space()
                .repeatWhile(() -> rounds.incrementAndGet() < 3, () -> (Promise<?>) null)
                .handle((value, error) -> log.add("ended with " + error)));
        assertThat(log)
                .containsExactly(
                        "ended with java.lang.NullPointerException: the function returned null, not a promise");
        assertThat(rounds).hasValue(1);
    }

    @Test
    void repeatWhile_onAnotherThread_isRefused_andNamesTheThreads() {
        try (var space = ActorSpace.create(SpaceSettings.named("loops"))) {
            assertThatThrownBy(() -> space.repeatWhile(() -> false, () -> {}))
                    .isInstanceOf(IllegalStateException.class)
                    .hasMessageContaining("repeatWhile(..) belongs on the thread of space loops");
        }
    }

    // ---- sequential bodies

    /** Makes two requests in a row, and can do other work meanwhile. */
    class Asker extends Actor {
        private final List<Deferred<String>> questions = new ArrayList<>();

        public Promise<String> askTwice() {
            return context().space().sequential(() -> {
                String first = firstAnswer();
                log.add("heard " + first);
                String second = question().await();
                context().after(SECOND, () -> log.add("timer of the actor"));
                return first + " " + second;
            });
        }

        public void answer(String text) {
            log.add("answers " + text);
            questions.removeFirst().resolve(text);
        }

        public void end() {
            context().stop();
        }

        private String firstAnswer() {
            try {
                return question().await();
            } catch (CancellationException cancelled) {
                log.add("cancelled: " + cancelled.getMessage());
                throw cancelled;
            }
        }

        private Promise<String> question() {
            questions.add(new Deferred<>());
            return questions.getLast();
        }
    }

    @Test
    void body_waitsWhileOthersAreServed_andGoesOnOnBehalfOfItsActor() {
        Asker asker = test.spawn(Asker.class, Asker::new);
        Promise<String> both = asker.askTwice();
        test.runQueued();
        assertThat(both.isDone()).isFalse();
        asker.answer("one");
        test.runQueued();
        asker.answer("two");
        assertThat(test.get(both)).isEqualTo("one two");
        test.advance(SECOND);
        assertThat(log).containsExactly("answers one", "heard one", "answers two", "timer of the actor");
    }

    @Test
    void body_thatIsCancelledBeforeItBegins_neverBegins() {
        test.space().sequential(() -> log.add("begun")).cancel();
        test.runQueued();
        assertThat(log).isEmpty();
    }

    @Test
    void await_throwsWhatThePromiseWasRejectedWith_unwrapped() {
        Promise<String> answer = test.space().sequential(() -> {
            try {
                return pending.await();
            } catch (Exception e) {
                return "caught " + e.getMessage();
            }
        });
        test.runQueued();
        pending.reject(new IOException("no map"));
        assertThat(test.get(answer)).isEqualTo("caught no map");
    }

    @Test
    void body_thatWaitsInAListenerOfAFuture_isResumed_andOthersAreServed() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("future"))) {
            Promise<String> answer = space.sequential(() -> {
                var first = new Deferred<String>();
                var second = new Deferred<String>();
                var both = first.toCompletableFuture().thenApply(text -> text + second.await());
                space.execute(() -> second.resolve("late")); // runs while the body waits in the listener
                first.resolve("soon, ");
                return both.join();
            });
            assertThat(answer.get(Duration.ofSeconds(60))).isEqualTo("soon, late");
        }
    }

    @Test
    void body_thatThrows_rejectsItsPromise() {
        Promise<Integer> answer = test.space().sequential(() -> {
            Promise.done().await();
            throw new IOException("out of paper");
        });
        assertThat(test.error(answer)).isInstanceOf(IOException.class).hasMessage("out of paper");
    }

    @Test
    void await_onTheSpacesThreadOrOutside_throwsAndNamesTheAlternative() {
        test.run(() -> assertThatThrownBy(pending::await)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContainingAll(
                        "would stop the whole space", "then(..)", "thenCompose(..)", "sequential(..)"));
        assertThatThrownBy(pending::await)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContainingAll("sequential(..)", "get(Duration)");
    }

    @Test
    void body_ofAnActorThatStops_isCancelledWhereItWaits() {
        Asker asker = test.spawn(Asker.class, Asker::new);
        Promise<String> both = asker.askTwice();
        test.runQueued();
        asker.end();
        assertThat(test.error(both))
                .isInstanceOf(ActorStoppedException.class)
                .hasMessageContaining("Asker#1 has stopped");
        assertThat(log).containsExactly("cancelled: the actor Asker#1 has stopped while a body of it waited");
    }

    @Test
    void body_inASpaceThatIsClosed_isCancelledWhereItWaits_andCounted() {
        var space = ActorSpace.create(SpaceSettings.named("short-lived").withoutThread());
        Deferred<String> gate = space.deferred();
        Promise<String> answer = space.sequential(() -> {
            try {
                return gate.await();
            } finally {
                log.add("finally");
            }
        });
        answer.exceptionally(error -> "");
        space.runQueued();
        assertThat(space.close(SECOND).sequences()).isEqualTo(1);
        assertThat(log).containsExactly("finally");
        assertThat(answer.error()).isInstanceOf(CancellationException.class).hasMessageContaining("short-lived");
    }

    @Test
    void bodies_takeTurns_eachFromOneWaitToTheNext() {
        var gates = List.of(test.space().<Integer>deferred(), test.space().<Integer>deferred());
        for (int index = 0; index < 2; index++) {
            int number = index;
            test.space().sequential(() -> {
                log.add("begin " + number);
                return log.add(number + " got " + gates.get(number).await());
            });
        }
        test.runQueued();
        gates.get(1).resolve(10);
        gates.get(0).resolve(20);
        test.runQueued();
        assertThat(log).containsExactly("begin 0", "begin 1", "1 got 10", "0 got 20");
    }

    @Test
    @Tag("threads")
    @Timeout(600)
    void bodies_ofASpaceWithAThread_neverRunTwoAtATime() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("sequential"))) {
            var counter = new int[1]; // without a lock on purpose
            var ends = new ArrayList<Promise<Integer>>();
            for (int body = 0; body < 50; body++) {
                ends.add(space.sequential(() -> {
                    for (int round = 0; round < 40; round++) {
                        int before = counter[0];
                        Thread.yield();
                        counter[0] = before + 1;
                        space.offload(() -> 1).await();
                    }
                    return 1;
                }));
            }
            assertThat(Promise.all(ends).get(Duration.ofMinutes(9))).hasSize(50); // 4,000 changes of the thread
            assertThat(counter[0]).isEqualTo(2000);
        }
    }

    @Test
    void threadOfABody_thatHasEnded_isNotTheSpacesAnyMore() throws Exception {
        SpaceHome space = test.space().home;
        var end = new Deferred<Boolean>();
        new SequentialBodies.Body<>(space, space.owner(), space::isCurrent, end).run();
        assertThat(end.get(PATIENCE)).isTrue();
        assertThat(space.isCurrent()).isFalse(); // though no other thread has taken control
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void bodiesOfTwoSpaces_onTheSameThreads_eachBelongToTheirOwnSpace() throws Exception {
        try (var first = ActorSpace.create(SpaceSettings.named("first"));
                var second = ActorSpace.create(SpaceSettings.named("second"))) {
            for (int round = 0; round < 100; round++) {
                var own = new ArrayList<Promise<Boolean>>();
                for (int body = 0; body < 20; body++) {
                    first.sequential(() -> true);
                    own.add(second.sequential(() -> !first.home.isCurrent()));
                }
                assertThat(Promise.all(own).get(PATIENCE)).containsOnly(true);
            }
        }
    }

    // ---- delays and time limits set by threads outside every space

    /** Answers when the test allows it. */
    public interface Sleeper {
        Promise<String> ask();
    }

    private static List<Thread> threadsNamed(String name) {
        return Thread.getAllStackTraces().keySet().stream()
                .filter(thread -> thread.getName().equals(name))
                .toList();
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void stalledSpace_itsTimeLimitsAndDelays_endAllTheSame() throws Exception {
        var wake = new CountDownLatch(1);
        try (var space = ActorSpace.create(SpaceSettings.named("stalled"))) {
            Sleeper sleeper = space.spawn(Sleeper.class, () -> () -> {
                await(wake);
                return Promise.of("awake");
            });
            Promise<String> asked = sleeper.ask();
            try {
                assertThatThrownBy(() -> asked.orTimeout(SOON).get(PATIENCE))
                        .isInstanceOf(TimeoutException.class)
                        .hasMessageContaining("within PT0.01S from Sleeper.ask() of Sleeper#1");
                space.delay(SOON).get(PATIENCE);
                assertThat(asked.isDone()).isFalse();
            } finally {
                wake.countDown();
            }
            assertThat(asked.get(PATIENCE)).isEqualTo("awake");
        }
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void listener_ofATimeLimitFromOutside_runsOnTheSpace() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("here"))) {
            var limited = space.<String>deferred().orTimeout(SOON).exceptionally(late -> threadName());
            var delayed = space.delay(SOON).thenApply(over -> threadName());
            assertThat(Promise.all(List.of(limited, delayed)).get(PATIENCE)).containsExactly("here", "here");
        }
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void manyTimeLimits_shareOneThread_andAreReleasedWhenTheirPromisesAreSettled() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("many"))) {
            var asked = new ArrayList<Deferred<Integer>>();
            var limited = new ArrayList<Promise<Integer>>();
            for (int number = 0; number < 10_000; number++) {
                asked.add(space.deferred());
                limited.add(asked.getLast().orTimeout(LONG));
            }
            assertThat(space.metrics().timers()).isEqualTo(10_000);
            assertThat(threadsNamed("many-timers")).hasSize(1).allMatch(Thread::isDaemon);
            asked.forEach(promise -> promise.resolve(1));
            assertThat(Promise.all(limited).get(PATIENCE)).hasSize(10_000);
            assertThat(space.metrics().timers()).isZero();
        }
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void spaceThatIsClosed_endsWhatWasAskedOfIt_andItsThread() throws Exception {
        var space = ActorSpace.create(SpaceSettings.named("closing"));
        Promise<?> delay = space.delay(LONG);
        Promise<?> limited = space.<String>deferred().orTimeout(LONG);
        List<Thread> threads = threadsNamed("closing-timers");
        assertThat(threads).hasSize(1);
        assertThat(space.close(PATIENCE).timers()).isEqualTo(2);
        for (var promise : List.of(delay, limited, space.delay(SOON))) {
            assertThatThrownBy(() -> promise.get(PATIENCE))
                    .isInstanceOf(CancellationException.class)
                    .hasMessageContaining("space closing was closed before");
        }
        threads.getFirst().join();
    }
}
