package io.troupe.actor;

import static io.troupe.actor.Concurrently.LONG;
import static io.troupe.actor.Concurrently.await;
import static io.troupe.actor.Concurrently.onThreads;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.catchThrowable;

import io.troupe.actor.ActorSettings.Overflow;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.function.Consumer;
import java.util.function.Supplier;
import java.util.stream.IntStream;
import org.assertj.core.api.ThrowableAssert.ThrowingCallable;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Tests on real threads: with latches only, and long time limits. */
@Tag("threads")
@Timeout(60)
class ActorSpaceThreadTest {
    private static ActorSpace space(String name) {
        return ActorSpace.create(SpaceSettings.named(name));
    }

    private static <T> T onItsThread(ActorSpace space, Supplier<T> task) throws Exception {
        var answer = new Deferred<T>();
        space.execute(() -> answer.resolve(task.get()));
        return answer.get(LONG);
    }

    // ---- calls

    /** The numbers that arrived, per sender; each sends 0, 1, 2 and so on, all at the same time. */
    private static List<ArrayList<Integer>> numbersOf(int senders, int calls, SpaceSettings space, ActorSettings sink) {
        var taken = IntStream.range(0, senders)
                .mapToObj(sender -> new ArrayList<Integer>())
                .toList();
        try (var receiving = ActorSpace.create(space)) {
            Doer receiver = receiving.spawn(Doer.class, Doer::new, sink);
            onThreads(senders, sender -> {
                for (int call = 0; call < calls; call++) {
                    int number = call;
                    receiver.run(me -> taken.get(sender).add(number));
                }
            });
        }
        return taken;
    }

    @Test
    void messages_ofSeveralThreads_allArriveInEachSendersOrder() {
        var all = IntStream.range(0, 50_000).boxed().toList();
        assertThat(numbersOf(4, 50_000, SpaceSettings.named("tally"), ActorSettings.defaults()))
                .hasSize(4)
                .allSatisfy(numbers -> assertThat(numbers).isEqualTo(all));
    }

    @Test
    void dropOldest_underSeveralSenders_servesOrDropsEachCallOnce_andKeepsTheNewest() {
        var dropped = new ConcurrentLinkedQueue<String>();
        var settings = SpaceSettings.named("dropping").withOnDeadLetter(letter -> dropped.add(letter.message()));
        var taken = numbersOf(3, 20_000, settings, ActorSettings.defaults().withMailbox(2, Overflow.DROP_OLDEST));
        int handled = taken.stream().mapToInt(List::size).sum();
        assertThat(handled + dropped.size()).isEqualTo(3 * 20_000);
        assertThat(taken)
                .allSatisfy(numbers -> assertThat(numbers).isSorted())
                .as("the last sender's last call was not dropped, because none came after it")
                .anyMatch(numbers -> !numbers.isEmpty() && numbers.getLast() == 20_000 - 1);
    }

    interface Fresh {
        Promise<String> hi();
    }

    @Test
    void firstSpawnOfAType_byManyThreadsAtOnce_works() throws Exception {
        try (var space = space("crowd")) {
            var answers = new ConcurrentLinkedQueue<Promise<String>>();
            onThreads(
                    8,
                    number -> answers.add(space.spawn(Fresh.class, () -> () -> Promise.of("hi"))
                            .hi()));
            assertThat(Promise.all(List.copyOf(answers)).get(LONG)).hasSize(8).containsOnly("hi");
        }
    }

    @Test
    void spacesTalkToEachOther_andListenersRunWhereTheyWereRegistered() throws Exception {
        try (var left = space("left");
                var right = space("right")) {
            Doer actor = right.spawn(Doer.class, Doer::new);
            var thread = new Deferred<String>();
            left.execute(() -> actor.ask(me -> Promise.of(1))
                    .thenRun(() -> thread.resolve(Thread.currentThread().getName())));
            assertThat(thread.get(LONG)).isEqualTo("left");
        }
    }

    @Test
    void get_onTheSpacesThread_throwsAndNamesTheAlternative() throws Exception {
        try (var space = space("own")) {
            Doer actor = space.spawn(Doer.class, Doer::new);
            ThrowingCallable wait = () -> actor.ask(me -> Promise.of(1)).get(LONG);
            Throwable thrown = onItsThread(space, () -> catchThrowable(wait));
            assertThat(thrown).isInstanceOf(IllegalStateException.class).hasMessageContaining("then(..)");
        }
    }

    @Test
    void get_thatTakesTooLong_reportsWhatItWaitedFor() {
        interface Silent {
            Promise<String> ask(String what);
        }
        try (var space = space("silent")) {
            Silent silent = space.spawn(Silent.class, () -> what -> new Deferred<>());
            assertThatThrownBy(() -> silent.ask("why").get(Duration.ofMillis(1)))
                    .isInstanceOf(TimeoutException.class)
                    .hasMessageContaining("Silent.ask(String) of Silent#1");
        }
    }

    @Test
    void sleepingSpace_isWokenByItsManualClock() throws Exception {
        var clock = new ManualClock();
        try (var space = ActorSpace.create(SpaceSettings.named("timed").withClock(clock))) {
            var rang = new Deferred<Long>();
            Doer alarm = space.spawn(Doer.class, Doer::new);
            alarm.run(me -> me.context().after(Duration.ofSeconds(5), () -> rang.resolve(clock.nanos())));
            var set = new Deferred<String>();
            space.onIdle(() -> set.resolve("set"));
            set.get(LONG);
            clock.advance(Duration.ofSeconds(4));
            assertThat(rang.isDone()).isFalse();
            clock.advance(Duration.ofSeconds(1));
            assertThat(rang.get(LONG)).isEqualTo(5_000_000_000L);
        }
    }

    interface Sink {
        void take(int number);
    }

    @Test
    void closedSpace_servesWhatWasQueuedAndRefusesWhatComesLater() throws Exception {
        var taken = new ArrayList<Integer>();
        var letters = new ArrayList<DeadLetter>();
        var space = ActorSpace.create(SpaceSettings.named("brief").withOnDeadLetter(letters::add));
        Sink sink = space.spawn(Sink.class, () -> taken::add);
        Doer doer = space.spawn(Doer.class, Doer::new);
        sink.take(1);
        Promise<Integer> before = doer.ask(me -> Promise.of(taken.size()));
        space.close();
        assertThat(before.get(LONG)).isEqualTo(1);
        assertThatThrownBy(() -> doer.ask(me -> Promise.of(2)).get(LONG))
                .isInstanceOf(ActorStoppedException.class)
                .hasMessageContaining("space brief is closed");
        sink.take(2);
        assertThat(letters)
                .containsExactly(new DeadLetter("Sink#1", "Sink.take(int)", List.of(2), "space brief is closed"));
        assertThatThrownBy(() -> space.spawn(Doer.class, Doer::new)).isInstanceOf(ActorStoppedException.class);
    }

    @Test
    void deadLetterHandlerThatThrows_doesNotEndTheSpace() throws Exception {
        var problems = new ArrayList<String>();
        var settings = SpaceSettings.named("tough")
                .withOnDeadLetter(letter -> {
                    throw new IllegalStateException("no letters, please");
                })
                .withOnError((where, error) -> problems.add(error.getMessage()));
        try (var space = ActorSpace.create(settings)) {
            Doer gone = space.spawn(Doer.class, Doer::new);
            Doer alive = space.spawn(Doer.class, Doer::new);
            space.stop(gone);
            gone.run(me -> {});
            assertThat(alive.ask(me -> Promise.of(0)).get(LONG)).isZero();
        }
        assertThat(problems).containsExactly("no letters, please");
    }

    // ---- messages that take too long

    private static ActorSpace watched(String name, Consumer<Stall> onStall) {
        return ActorSpace.create(SpaceSettings.named(name).withOnStall(Duration.ofMillis(20), onStall));
    }

    @Test
    void messageThatTakesTooLong_isReportedOnce_withItsStack() throws Exception {
        Stall stall = stallOf(space -> {
            space.execute(this::holdTheThread);
            onItsThread(space, () -> "after");
        });
        assertThat(stall.space()).isEqualTo("slow");
        assertThat(stall.atLeast()).isGreaterThanOrEqualTo(Duration.ofMillis(20));
        assertThat(stall.toString()).contains("space slow has been busy", "offload", "holdTheThread");
    }

    @Test
    void listenerThatTakesTooLong_isReportedAsAMessageIs() throws Exception {
        stallOf(space -> {
            Deferred<String> deferred = space.deferred();
            var end = deferred.thenRun(this::holdTheThread);
            deferred.resolve("now");
            end.get(LONG);
        });
    }

    private final CountDownLatch reported = new CountDownLatch(1);

    private void holdTheThread() {
        await(reported);
    }

    private interface Task {
        void run(ActorSpace space) throws Exception;
    }

    /** The first stall of a task that calls {@link #holdTheThread}, which its stack must name. */
    private Stall stallOf(Task task) throws Exception {
        var stalls = new ArrayList<Stall>();
        Consumer<Stall> onStall = stall -> {
            stalls.add(stall);
            reported.countDown();
        };
        try (var space = watched("slow", onStall)) {
            task.run(space);
        }
        assertThat(stalls.getFirst().stack())
                .anyMatch(frame -> frame.getMethodName().equals("holdTheThread"));
        return stalls.getFirst();
    }

    @Test
    @Timeout(120)
    void stallListener_thatWaits_doesNotKeepOtherSpacesFromBeingWatched() throws Exception {
        var otherReported = new CountDownLatch(1);
        var firstListening = new CountDownLatch(1);
        Consumer<Stall> patient = stall -> {
            firstListening.countDown();
            await(otherReported);
        };
        try (var first = watched("first", patient);
                var second = watched("second", stall -> otherReported.countDown())) {
            first.execute(() -> await(firstListening));
            await(firstListening);
            second.execute(() -> await(otherReported));
            assertThat(otherReported.await(30, TimeUnit.SECONDS)).isTrue();
        }
    }

    @Test
    @Timeout(120)
    void sleepingSpace_isNotSeenInATurn_andABusyOneIs() throws Exception {
        try (var space = space("asleep")) {
            Thread own = onItsThread(space, Thread::currentThread);
            while (own.getState() == Thread.State.RUNNABLE) {
                Thread.onSpinWait(); // until it sleeps
            }
            assertThat(Watchdog.isInATurn(List.of(own.getStackTrace()))).isFalse();
            assertThat(Watchdog.isInATurn(onItsThread(space, () -> List.of(own.getStackTrace()))))
                    .isTrue();
            var inBody = space.sequential(() -> List.of(Thread.currentThread().getStackTrace()));
            assertThat(Watchdog.isInATurn(inBody.get(LONG))).isTrue();
        }
    }

    // ---- virtual threads that compute occupy all carriers; spaces do not depend on these

    private static void whileAllCarriersAreBusy(ActorSpace space, Task task) throws Exception {
        int processors = Runtime.getRuntime().availableProcessors();
        int carriers = Integer.getInteger("jdk.virtualThreadScheduler.parallelism", processors);
        var computing = new AtomicBoolean(true);
        var begun = new CountDownLatch(carriers);
        var threads = new ArrayList<Thread>();
        for (int carrier = 0; carrier < carriers; carrier++) {
            threads.add(Thread.ofVirtual().start(() -> {
                begun.countDown();
                while (computing.get()) {
                    Thread.onSpinWait();
                }
            }));
        }
        try {
            assertThat(begun.await(30, TimeUnit.SECONDS)).isTrue();
            task.run(space);
        } finally {
            computing.set(false);
            for (Thread thread : threads) {
                thread.join();
            }
        }
    }

    @Test
    @Timeout(120)
    void sequentialBody_runsWhileAllCarriersCompute() throws Exception {
        try (var space = space("bodies")) {
            whileAllCarriersAreBusy(space, busy -> {
                Promise<Integer> sum = space.sequential(() -> {
                    int first = space.delay(Duration.ZERO).thenApply(over -> 1).await();
                    return first + 1;
                });
                assertThat(sum.get(LONG)).isEqualTo(2);
            });
        }
    }

    @Test
    @Timeout(120)
    void stall_isReportedWhileAllCarriersCompute() throws Exception {
        try (var space = watched("watched", stall -> reported.countDown())) {
            whileAllCarriersAreBusy(space, busy -> {
                busy.execute(this::holdTheThread);
                assertThat(reported.await(30, TimeUnit.SECONDS)).isTrue();
            });
        }
    }

    @Test
    @Timeout(120)
    void thousandsOfBodies_mayWaitAtATime() throws Exception {
        int bodies = 2_000;
        try (var space = space("many-bodies")) {
            Deferred<Integer> gate = space.deferred();
            var ends = new ArrayList<Promise<Integer>>();
            for (int number = 0; number < bodies; number++) {
                ends.add(space.sequential(gate::await));
            }
            space.execute(() -> gate.resolve(1)); // queued behind the starts of all bodies
            assertThat(Promise.all(ends).get(LONG)).hasSize(bodies).containsOnly(1);
        }
    }
}
