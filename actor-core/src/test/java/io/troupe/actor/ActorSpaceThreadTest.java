package io.troupe.actor;

import static io.troupe.actor.Concurrently.LONG;
import static io.troupe.actor.Concurrently.await;
import static io.troupe.actor.Concurrently.onThreads;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.catchThrowable;

import io.troupe.actor.MailboxBound.Overflow;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.ManualClock;
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

    interface Tally {
        void add(int sender, int number);

        Promise<Long> count();
    }

    static final class StrictTally implements Tally {
        private final int[] last = new int[8];
        private final List<Integer> disordered = new ArrayList<>();
        private long count;

        @Override
        public void add(int sender, int number) {
            if (number != last[sender] + 1) {
                disordered.add(number);
            }
            last[sender] = number;
            count++;
        }

        @Override
        public Promise<Long> count() {
            return Promise.of(count);
        }
    }

    @Test
    void messages_ofSeveralThreads_allArriveInEachSendersOrder() throws Exception {
        try (var space = space("tally")) {
            var strict = new StrictTally();
            Tally tally = space.spawn(Tally.class, () -> strict);
            int senders = 4;
            int each = 50_000;
            onThreads(senders, sender -> {
                for (int number = 1; number <= each; number++) {
                    tally.add(sender, number);
                }
            });
            assertThat(tally.count().get(LONG)).isEqualTo((long) senders * each);
            assertThat(strict.disordered).isEmpty();
        }
    }

    @Test
    void dropOldest_underSeveralSenders_servesOrDropsEachCallOnce_andKeepsTheNewest() {
        int senders = 3;
        int calls = 20_000;
        var dropped = new ConcurrentLinkedQueue<String>();
        var taken = IntStream.range(0, senders)
                .mapToObj(sender -> new ArrayList<Integer>())
                .toList();
        var space = ActorSpace.create(
                SpaceSettings.named("dropping").withOnDeadLetter(letter -> dropped.add(letter.message())));
        Doer sink = space.spawn(Doer.class, Doer::new, ActorSettings.DEFAULT.withMailbox(2, Overflow.DROP_OLDEST));
        onThreads(senders, sender -> {
            for (int call = 0; call < calls; call++) {
                int number = call;
                sink.run(me -> taken.get(sender).add(number));
            }
        });
        space.close();
        int handled = taken.stream().mapToInt(List::size).sum();
        assertThat(handled + dropped.size()).isEqualTo(senders * calls);
        assertThat(taken).allSatisfy(numbers -> assertThat(numbers).isSorted());
        assertThat(taken)
                .as("the last sender's last call was not dropped, because none came after it")
                .anyMatch(numbers -> !numbers.isEmpty() && numbers.getLast() == calls - 1);
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
            Tally tally = right.spawn(Tally.class, StrictTally::new);
            var thread = new Deferred<String>();
            left.execute(() -> tally.count()
                    .thenRun(() -> thread.resolve(Thread.currentThread().getName())));
            assertThat(thread.get(LONG)).isEqualTo("left");
        }
    }

    @Test
    void get_onTheSpacesThread_throwsAndNamesTheAlternative() throws Exception {
        try (var space = space("own")) {
            Tally tally = space.spawn(Tally.class, StrictTally::new);
            Throwable thrown =
                    onItsThread(space, () -> catchThrowable(() -> tally.count().get(LONG)));
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
                    .hasMessageContaining("Silent.ask(why) of Silent#1");
        }
    }

    @Test
    void sleepingSpace_isWokenByItsManualClock() throws Exception {
        var clock = new ManualClock();
        try (var space = ActorSpace.create(SpaceSettings.named("timed").withClock(clock))) {
            var rang = new Deferred<Long>();
            Doer alarm = space.spawn(Doer.class, Doer::new);
            alarm.run(me -> me.after(Duration.ofSeconds(5), () -> rang.resolve(clock.nanos())));
            var set = new Deferred<String>();
            space.onIdle(() -> set.resolve("set"));
            set.get(LONG);
            clock.advance(Duration.ofSeconds(4));
            assertThat(rang.isDone()).isFalse();
            clock.advance(Duration.ofSeconds(1));
            assertThat(rang.get(LONG)).isEqualTo(5_000_000_000L);
        }
    }

    @Test
    void closedSpace_servesWhatWasQueuedAndRefusesWhatComesLater() throws Exception {
        var letters = new ArrayList<DeadLetter>();
        var space = ActorSpace.create(SpaceSettings.named("brief").withOnDeadLetter(letters::add));
        Tally tally = space.spawn(Tally.class, StrictTally::new);
        tally.add(0, 1);
        Promise<Long> before = tally.count();
        space.close();
        assertThat(before.get(LONG)).isEqualTo(1);
        assertThatThrownBy(() -> tally.count().get(LONG))
                .isInstanceOf(ActorStoppedException.class)
                .hasMessageContaining("space brief is closed");
        tally.add(0, 2);
        assertThat(letters).containsExactly(new DeadLetter("Tally#1", "Tally.add(0, 2)", "space brief is closed"));
        assertThatThrownBy(() -> space.spawn(Tally.class, StrictTally::new)).isInstanceOf(ActorStoppedException.class);
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
            Tally gone = space.spawn(Tally.class, StrictTally::new);
            Tally alive = space.spawn(Tally.class, StrictTally::new);
            space.stop(gone);
            gone.add(0, 1);
            assertThat(alive.count().get(LONG)).isZero();
        }
        assertThat(problems).containsExactly("no letters, please");
    }

    // ---- messages that take too long

    private static ActorSpace watched(String name, Consumer<Stall> onStall) {
        return ActorSpace.create(SpaceSettings.named(name).withOnStall(Duration.ofMillis(20), onStall));
    }

    private static void holdTheThread(CountDownLatch until) {
        await(until);
    }

    @Test
    void messageThatTakesTooLong_isReportedOnce_withItsStack() throws Exception {
        var stalls = new ArrayList<Stall>();
        var reported = new CountDownLatch(1);
        Consumer<Stall> onStall = stall -> {
            stalls.add(stall);
            reported.countDown();
        };
        try (var space = watched("slow", onStall)) {
            space.execute(() -> holdTheThread(reported));
            assertThat(onItsThread(space, () -> "after")).isEqualTo("after");
        }
        Stall stall = stalls.getFirst();
        assertThat(stall.space()).isEqualTo("slow");
        assertThat(stall.atLeast()).isGreaterThanOrEqualTo(Duration.ofMillis(20));
        assertThat(stall.stack()).anyMatch(frame -> frame.getMethodName().equals("holdTheThread"));
        assertThat(stall.toString()).contains("space slow has been busy", "offload", "holdTheThread");
    }

    @Test
    void listenerThatTakesTooLong_isReportedAsAMessageIs() throws Exception {
        var stacks = new ArrayList<StackTraceElement>();
        var reported = new CountDownLatch(1);
        Consumer<Stall> onStall = stall -> {
            stacks.addAll(stall.stack());
            reported.countDown();
        };
        try (var space = watched("slow", onStall)) {
            var deferred = new Deferred<String>(space);
            var end = deferred.thenRun(() -> holdTheThread(reported));
            deferred.resolve("now");
            end.get(LONG);
        }
        assertThat(stacks).anyMatch(frame -> frame.getMethodName().equals("holdTheThread"));
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

    private interface Task {
        void run() throws Exception;
    }

    private static void whileAllCarriersAreBusy(Task task) throws Exception {
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
            task.run();
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
            whileAllCarriersAreBusy(() -> {
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
        var reported = new CountDownLatch(1);
        try (var space = watched("watched", stall -> reported.countDown())) {
            whileAllCarriersAreBusy(() -> {
                space.execute(() -> await(reported));
                assertThat(reported.await(30, TimeUnit.SECONDS)).isTrue();
            });
        }
    }

    @Test
    @Timeout(120)
    void thousandsOfBodies_mayWaitAtATime() throws Exception {
        int bodies = 2_000;
        try (var space = space("many-bodies")) {
            var gate = new Deferred<Integer>(space);
            var ends = new ArrayList<Promise<Integer>>();
            for (int number = 0; number < bodies; number++) {
                ends.add(space.sequential(gate::await));
            }
            space.execute(() -> gate.resolve(1)); // queued behind the starts of all bodies
            assertThat(Promise.all(ends).get(LONG)).hasSize(bodies).containsOnly(1);
        }
    }
}
