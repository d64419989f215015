package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.ManualClock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicReference;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Tests on real threads: with latches only, and long time limits. */
@Tag("threads")
@Timeout(60)
class ActorSpaceThreadTest {
    private static final Duration LONG = Duration.ofSeconds(30);

    interface Tally {
        void add(int sender, int number);

        Promise<List<Integer>> disordered();

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
        public Promise<List<Integer>> disordered() {
            return Promise.of(disordered);
        }

        @Override
        public Promise<Long> count() {
            return Promise.of(count);
        }
    }

    @Test
    void messages_ofSeveralThreads_allArriveInEachSendersOrder() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("tally"))) {
            Tally tally = space.spawn(Tally.class, StrictTally::new);
            int senders = 4;
            int each = 50_000;
            var threads = new ArrayList<Thread>();
            for (int sender = 0; sender < senders; sender++) {
                int id = sender;
                threads.add(Thread.ofPlatform().start(() -> {
                    for (int number = 1; number <= each; number++) {
                        tally.add(id, number);
                    }
                }));
            }
            for (var thread : threads) {
                thread.join();
            }
            assertThat(tally.count().get(LONG)).isEqualTo((long) senders * each);
            assertThat(tally.disordered().get(LONG)).isEmpty();
        }
    }

    @Test
    void spacesTalkToEachOther_andListenersRunWhereTheyWereRegistered() throws Exception {
        try (var left = ActorSpace.create(SpaceSettings.named("left"));
                var right = ActorSpace.create(SpaceSettings.named("right"))) {
            Tally tally = right.spawn(Tally.class, StrictTally::new);
            var thread = new AtomicReference<String>();
            var done = new CountDownLatch(1);
            left.execute(() -> tally.count().then(count -> {
                thread.set(Thread.currentThread().getName());
                done.countDown();
            }));
            assertThat(done.await(30, TimeUnit.SECONDS)).isTrue();
            assertThat(thread.get()).isEqualTo("left");
        }
    }

    @Test
    void get_onTheSpacesThread_throwsAndNamesTheAlternative() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("own"))) {
            Tally tally = space.spawn(Tally.class, StrictTally::new);
            var answer = new Deferred<Throwable>();
            space.execute(() -> {
                try {
                    tally.count().get(LONG);
                } catch (Exception e) {
                    answer.resolve(e);
                }
            });
            assertThat(answer.get(LONG))
                    .isInstanceOf(IllegalStateException.class)
                    .hasMessageContaining("then(..)");
        }
    }

    @Test
    void get_thatTakesTooLong_reportsWhatItWaitedFor() {
        interface Silent {
            Promise<String> ask(String what);
        }
        try (var space = ActorSpace.create(SpaceSettings.named("silent"))) {
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
            class Alarm extends Actor {
                private final Deferred<Long> rang;

                Alarm(Deferred<Long> rang) {
                    this.rang = rang;
                }

                @Override
                protected void started() {
                    after(Duration.ofSeconds(5), () -> rang.resolve(clock.nanos()));
                }
            }
            var rang = new Deferred<Long>();
            space.spawn(Alarm.class, () -> new Alarm(rang));
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
    void messageThatTakesTooLong_isReportedOnce_withItsStack() throws Exception {
        var stalls = new ArrayList<Stall>();
        var reported = new CountDownLatch(1);
        var settings = SpaceSettings.named("slow").withOnStall(Duration.ofMillis(20), stall -> {
            stalls.add(stall);
            reported.countDown();
        });
        try (var space = ActorSpace.create(settings)) {
            space.execute(() -> holdTheThread(reported));
            var after = new CountDownLatch(1);
            space.execute(after::countDown);
            assertThat(after.await(30, TimeUnit.SECONDS)).isTrue();
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
        var settings = SpaceSettings.named("slow").withOnStall(Duration.ofMillis(20), stall -> {
            stacks.addAll(stall.stack());
            reported.countDown();
        });
        try (var space = ActorSpace.create(settings)) {
            var deferred = new Deferred<String>(space);
            var end = deferred.thenRun(() -> holdTheThread(reported));
            deferred.resolve("now");
            end.get(Duration.ofSeconds(30));
        }
        assertThat(stacks).anyMatch(frame -> frame.getMethodName().equals("holdTheThread"));
    }

    private static void holdTheThread(CountDownLatch until) {
        try {
            until.await();
        } catch (InterruptedException e) {
            throw new IllegalStateException(e);
        }
    }

    interface Fresh {
        Promise<String> hi();
    }

    @Test
    void firstSpawnOfAType_byManyThreadsAtOnce_works() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("crowd"))) {
            var begin = new CountDownLatch(1);
            var answers = new ArrayList<Promise<String>>();
            var threads = new ArrayList<Thread>();
            for (int i = 0; i < 8; i++) {
                threads.add(Thread.ofPlatform().start(() -> {
                    holdTheThread(begin);
                    Fresh fresh = space.spawn(Fresh.class, () -> () -> Promise.of("hi"));
                    synchronized (answers) {
                        answers.add(fresh.hi());
                    }
                }));
            }
            begin.countDown();
            for (var thread : threads) {
                thread.join();
            }
            assertThat(Promise.all(answers).get(LONG)).hasSize(8).containsOnly("hi");
        }
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
}
