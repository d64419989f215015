package io.troupe.actor;

import static io.troupe.actor.Concurrently.await;
import static io.troupe.actor.Concurrently.onAnotherThread;
import static io.troupe.actor.Concurrently.onThreads;
import static java.util.stream.Collectors.groupingBy;
import static java.util.stream.Collectors.mapping;
import static java.util.stream.Collectors.toList;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatNullPointerException;

import io.troupe.actor.testkit.CallbackProbe;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.atomic.AtomicReference;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The values of a topic, its end, when subscriptions are removed, and all this on several threads. */
class TopicTest extends InTestSpace {
    private static final Duration LONG = Duration.ofSeconds(30);
    private static final int PUBLISHERS = 3;
    private static final int EACH = 20_000;

    private final TestSpace elsewhere = new TestSpace();
    private final Topic<Integer> topic = Topic.of(test.space(), "range");
    private final Topic<Integer> latest = Topic.latest(test.space(), "last range");
    private final CallbackProbe<Integer> probe = test.callback();
    private final CallbackProbe<Integer> other = test.callback();
    private final IllegalStateException unplugged = new IllegalStateException("unplugged");

    /** Runs the tasks of the test as an actor. */
    static class Robot extends Actor {
        private final Runnable first;

        Robot(Runnable first) {
            this.first = first;
        }

        @Override
        protected void started() {
            first.run();
        }

        public void act(Runnable action) {
            action.run();
        }
    }

    /** Passes its callbacks on to a topic. */
    interface Sensor {
        void readings(Callback<Integer> readings);
    }

    private Robot robotThat(TestSpace where, Runnable first) {
        return where.spawn(Robot.class, () -> new Robot(first));
    }

    /** Subscribes when it starts. */
    private Robot subscriber(Supervision supervision) {
        var settings = ActorSettings.defaults().withSupervision(supervision);
        return test.spawn(Robot.class, () -> new Robot(this::subscribe), settings);
    }

    private Callback.Stream<Integer> subscribe() {
        return topic.subscribe(value -> log.add("heard " + value));
    }

    private String here() {
        return ActorSpace.current() == elsewhere.space() ? "elsewhere" : "test";
    }

    @AfterEach
    void nothingIsLeftElsewhere() {
        elsewhere.close();
    }

    @Test
    void values_reachEverySubscriber_inTheOrderInWhichTheyWerePublished() {
        assertThat(topic.publish(0)).as("nobody subscribes").isZero();
        topic.subscribe(value -> log.add("a" + value));
        topic.subscribe((value, error) -> log.add("b" + value));
        assertThat(topic.publish(1)).isEqualTo(2);
        assertThat(topic.publish(2)).isEqualTo(2);
        assertThat(log).isEmpty();
        test.runQueued();
        assertThat(log).containsExactly("a1", "b1", "a2", "b2");
    }

    @Test
    void subscriber_receivesOnItsSpace_inTheCallbackQueue_neverOnThePublishersStack() {
        Robot robot = robotThat(elsewhere, () -> {});
        robot.act(() -> {
            topic.subscribe(value -> log.add(value + " in " + here()));
            robot.act(() -> log.add("mail"));
            log.add("sent to " + topic.publish(7));
        });
        elsewhere.runQueued();
        assertThat(log).containsExactly("sent to 1", "7 in elsewhere", "mail");
        log.clear();
        topic.subscribe(value -> log.add(value + " in " + here()));
        assertThat(topic.publish(8)).isEqualTo(2);
        test.runQueued();
        assertThat(log).as("heard in the publisher's space").containsExactly("8 in test");
        elsewhere.runQueued();
        assertThat(log).containsExactly("8 in test", "8 in elsewhere");
    }

    @Test
    void subscriberOfALatestTopic_receivesTheLastValueFirst_evenIfNobodyReceivedIt() {
        assertThat(latest.publish(0)).isZero();
        latest.subscribe(value -> log.add("early " + value));
        latest.publish(1);
        latest.publish(2);
        latest.subscribe(value -> log.add("late " + value));
        latest.publish(3);
        test.runQueued();
        assertThat(log).containsExactly("early 0", "early 1", "early 2", "late 2", "early 3", "late 3");
    }

    @Test
    void subscriber_maySubscribeAndCancelAndPublish_whileItReceives() {
        var subscription = new AtomicReference<Callback.Stream<Integer>>();
        subscription.set(topic.subscribe(value -> {
            log.add("first " + value);
            subscription.get().cancel();
            topic.subscribe(later -> log.add("second " + later));
            topic.publish(value + 1);
        }));
        topic.publish(1);
        test.runQueued();
        assertThat(log).containsExactly("first 1", "second 2");
        assertThat(topic.subscribers()).isOne();
    }

    /**
     * A space runs what its own thread has queued before what other threads queued a moment earlier; a topic keeps its
     * order all the same.
     */
    @Test
    void valuesAndEnd_fromTheSubscribersOwnThread_doNotOvertakeThoseFromAnother() {
        topic.subscribe((value, error) -> log.add(error == null ? "heard " + value : error.getMessage()));
        test.run(() -> {
            onAnotherThread(() -> topic.publish(1));
            topic.publish(2);
            onAnotherThread(() -> topic.publish(3));
            topic.fail(unplugged);
        });
        assertThat(log).containsExactly("heard 1", "heard 2", "heard 3", "unplugged");
    }

    @Test
    void lastValue_forASubscriberFromAnotherThread_isNotOvertakenByANewerOne() {
        latest.publish(1);
        test.run(() -> {
            onAnotherThread(() -> latest.subscribe(value -> log.add("heard " + value)));
            latest.publish(2);
        });
        assertThat(log).containsExactly("heard 1", "heard 2");
    }

    @Test
    void null_isRejected() {
        assertThatNullPointerException().isThrownBy(() -> topic.publish(null)).withMessage("value");
        assertThatNullPointerException().isThrownBy(() -> topic.fail(null)).withMessage("error");
        assertThatNullPointerException()
                .isThrownBy(() -> topic.subscribe((Callback<Integer>) null))
                .withMessage("callback");
    }

    @Test
    void methodReference_thatWouldFitBothMethods_subscribesToTheValues() {
        Topic<String> names = Topic.of(test.space(), "names");
        names.subscribe(log::add);
        CallbackProbe<String> first = test.callback();
        CallbackProbe<String> second = test.callback();
        names.subscribe(first, second);
        assertThat(names.publish("Ann")).isEqualTo(3);
        test.runQueued();
        assertThat(List.of(log, first.results(), second.results())).containsOnly(List.of("Ann"));
    }

    // ---- the end of a topic

    @Test
    void finish_endsEverySubscription_afterTheValuesBefore_andLaterOnesAtOnce() {
        latest.subscribe(probe);
        latest.subscribe(other);
        latest.publish(1);
        assertThat(latest.finish()).isTrue();
        assertThat(probe.results()).containsExactly(1);
        probe.expectFinished();
        other.expectFinished();
        assertThat(latest.publish(2)).isZero();
        assertThat(latest.subscribers()).isZero();
        assertThat(probe.results()).containsExactly(1);
        CallbackProbe<Integer> late = test.callback();
        latest.subscribe(late);
        assertThat(late.results()).isEmpty();
        late.expectFinished();
        assertThat(latest.remembered()).isZero();
    }

    @Test
    void fail_endsEverySubscription_alsoLaterOnes_andOnlyTheFirstEndCounts() {
        topic.subscribe(probe);
        assertThat(topic.fail(unplugged)).isTrue();
        assertThat(topic.fail(new IllegalStateException("again"))).isFalse();
        assertThat(topic.finish()).isFalse();
        topic.subscribe(other);
        assertThat(List.of(probe.expectFailed(), other.expectFailed())).allMatch(error -> error == unplugged);
    }

    @Test
    void failure_ofATopic_isTheFailureOfASubscriberThatTakesValuesOnly() {
        subscriber(Supervision.RESUME);
        topic.fail(unplugged);
        test.runQueued();
        assertThat(test.takeProblems()).singleElement().satisfies(problem -> {
            assertThat(problem.where()).contains("Robot#1");
            assertThat(problem.error())
                    .isInstanceOf(ActorException.class)
                    .hasMessageContaining("topic range has failed")
                    .hasCause(unplugged);
        });
    }

    // ---- when subscriptions are removed

    @Test
    void cancelledSubscription_receivesNothingMore_notEvenWhatWasSent_andIsRemoved() {
        var subscription = subscribe();
        topic.publish(1);
        subscription.cancel();
        test.runQueued();
        assertThat(topic.publish(2)).isZero();
        test.runQueued();
        assertThat(log).isEmpty();
        for (int i = 0; i < 1_000; i++) {
            subscribe().cancel(); // removed without a publisher
        }
        topic.subscribe(value -> {});
        assertThat(topic.remembered()).isOne();
        assertThat(topic.subscribers()).isOne();
    }

    @Test
    void subscriberThatHasStopped_isForgotten_withoutAPublisher() {
        for (int i = 0; i < 100; i++) {
            Robot robot = robotThat(test, this::subscribe);
            assertThat(topic.subscribers()).isOne();
            stop(robot);
            assertThat(topic.remembered()).as("the one that has just stopped").isOne();
        }
        assertThat(topic.publish(1)).isZero();
        assertThat(topic.remembered()).isZero();
        test.runQueued();
        assertThat(log).isEmpty();
    }

    @Test
    void valueOnItsWay_toASubscriberThatStops_isDropped() {
        subscriber(Supervision.STOP).act(() -> {
            assertThat(topic.publish(2)).as("it has not stopped yet").isOne();
            throw new IllegalStateException("on purpose"); // ends it before the next entry
        });
        test.runQueued();
        assertThat(takeErrors()).containsExactly("on purpose");
        assertThat(log).isEmpty();
    }

    @Test
    void restartedActor_subscribesAnew_andReceivesOnce() {
        subscriber(Supervision.restart(3, Duration.ofSeconds(10))).act(() -> {
            throw new IllegalStateException("on purpose");
        });
        test.runQueued();
        assertThat(test.takeProblems()).hasSize(1);
        assertThat(topic.publish(1)).isOne();
        test.runQueued();
        assertThat(log).containsExactly("heard 1");
    }

    @Test
    void subscriberInAClosedSpace_isForgotten_andItsCodeNeverRunsOnThePublishersThread() {
        try (var closed = new TestSpace()) {
            closed.run(this::subscribe);
            robotThat(closed, this::subscribe);
            assertThat(topic.subscribers()).isEqualTo(2);
        }
        topic.publish(1);
        assertThat(topic.publish(2)).isZero();
        assertThat(log).isEmpty();
    }

    @Test
    void callbackThatAnActorWasHanded_runsWhereItsReaderIs_andIsForgottenWithIt() {
        Sensor sensor = test.spawn(Sensor.class, () -> topic::subscribe);
        Robot robot = robotThat(elsewhere, () -> sensor.readings((value, error) -> log.add(value + " in " + here())));
        test.runQueued();
        topic.publish(3);
        test.runQueued();
        assertThat(log).isEmpty();
        elsewhere.runQueued();
        assertThat(log).containsExactly("3 in elsewhere");
        elsewhere.space().stop(robot);
        elsewhere.runQueued();
        assertThat(topic.publish(4)).isZero();
    }

    @Test
    void callbackThatAnotherSenderHasEnded_isNoErrorOfThePublisher() {
        var kept = new AtomicReference<Callback<Integer>>();
        Sensor sensor = test.spawn(Sensor.class, () -> readings -> {
            kept.set(readings);
            topic.subscribe(readings);
        });
        sensor.readings(probe);
        test.runQueued();
        kept.get().finish();
        assertThat(topic.publish(1)).isZero();
        assertThat(topic.finish()).isTrue();
        assertThat(probe.results()).isEmpty();
        probe.expectFinished();
    }

    @Test
    void subscriberThatThrows_failsAlone_andStaysSubscribed() {
        robotThat(
                test,
                () -> topic.subscribe(value -> {
                    throw new IllegalStateException("cannot use " + value);
                }));
        subscribe();
        topic.publish(1);
        test.runQueued();
        assertThat(topic.publish(2)).isEqualTo(2);
        test.runQueued();
        assertThat(log).containsExactly("heard 1", "heard 2");
        assertThat(takeErrors()).containsExactly("cannot use 1", "cannot use 2");
    }

    @Test
    void callbackWhoseIsCancelledThrows_isReported_andForgotten() {
        topic.subscribe(new Callback<Integer>() {
            private int asked;

            @Override
            public void accept(@Nullable Integer value, @Nullable Throwable error) {
                log.add("broken one heard " + value);
            }

            @Override
            public boolean isCancelled() {
                if (asked++ > 0) {
                    throw new IllegalStateException("broken");
                }
                return false;
            }
        });
        subscribe();
        assertThat(topic.publish(1)).isEqualTo(2);
        test.runQueued();
        assertThat(topic.publish(2)).isEqualTo(2);
        test.runQueued();
        assertThat(topic.publish(3)).as("it is forgotten").isOne();
        test.runQueued();
        assertThat(log).containsExactly("broken one heard 1", "heard 1", "heard 2", "heard 3");
        assertThat(takeErrors()).containsExactly("broken");
    }

    // ---- several threads

    record Reading(int publisher, int number) {}

    static class Recorder extends Actor {
        private final Topic<Reading> topic;
        private final CountDownLatch all;
        private final List<Reading> heard = new ArrayList<>();

        Recorder(Topic<Reading> topic, CountDownLatch all) {
            this.topic = topic;
            this.all = all;
        }

        @Override
        protected void started() {
            topic.subscribe(new Callback.Stream<>(heard::add, end -> all.countDown()));
        }

        public Promise<List<Reading>> heard() {
            return Promise.of(heard);
        }
    }

    private static void awaitInTime(CountDownLatch latch) throws InterruptedException {
        assertThat(latch.await(30, TimeUnit.SECONDS)).isTrue();
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void publishersOnSeveralThreads_reachAllSpaces_inOneOrder_whileOthersComeAndGo() throws Exception {
        try (var left = ActorSpace.create(SpaceSettings.named("left"));
                var right = ActorSpace.create(SpaceSettings.named("right"))) {
            Topic<Reading> readings = Topic.of(left, "readings");
            var all = new CountDownLatch(2);
            Recorder first = left.spawn(Recorder.class, () -> new Recorder(readings, all));
            Recorder second = right.spawn(Recorder.class, () -> new Recorder(readings, all));
            first.heard().get(LONG);
            second.heard().get(LONG);
            var publishing = new AtomicBoolean(true);
            var passing = new AtomicInteger();
            Thread passer = Thread.ofPlatform().start(() -> {
                while (publishing.get()) {
                    readings.subscribe(value -> {}).cancel();
                    passing.incrementAndGet();
                }
            });
            var tooFew = new AtomicInteger();
            onThreads(PUBLISHERS, publisher -> {
                for (int number = 0; number < EACH; number++) {
                    if (readings.publish(new Reading(publisher, number)) < 2) {
                        tooFew.incrementAndGet();
                    }
                }
            });
            publishing.set(false);
            passer.join();
            readings.finish();
            awaitInTime(all);

            var heard = first.heard().get(LONG);
            assertThat(heard)
                    .hasSize(PUBLISHERS * EACH)
                    .isEqualTo(second.heard().get(LONG));
            assertThat(tooFew).hasValue(0);
            assertThat(passing.get()).isPositive();
            var numbers = heard.stream().collect(groupingBy(Reading::publisher, mapping(Reading::number, toList())));
            assertThat(numbers).hasSize(PUBLISHERS);
            assertThat(numbers.values())
                    .containsOnly(IntStream.range(0, EACH).boxed().toList());
        }
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void lateSubscriber_ofALatestTopic_missesNothingAndReceivesNothingTwice() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("late"))) {
            Topic<Integer> count = Topic.latest(space, "count");
            var subscribing = new CountDownLatch(1);
            Thread publisher = Thread.ofPlatform().start(() -> {
                for (int number = 0; number < EACH; number++) {
                    count.publish(number);
                    if (number == EACH / 100) {
                        subscribing.countDown();
                    }
                }
                count.finish();
            });
            awaitInTime(subscribing);
            var rounds = new ArrayList<List<Integer>>();
            var ends = new ArrayList<CountDownLatch>();
            for (int round = 0; round < 50; round++) {
                var heard = new ArrayList<Integer>();
                var end = new CountDownLatch(1);
                count.subscribe(new Callback.Stream<>(heard::add, error -> end.countDown()));
                rounds.add(heard);
                ends.add(end);
            }
            publisher.join();
            for (var end : ends) {
                awaitInTime(end);
            }
            for (var heard : rounds) {
                int from = heard.isEmpty() ? EACH : heard.getFirst();
                assertThat(heard).isEqualTo(IntStream.range(from, EACH).boxed().toList());
            }
        }
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void slowSubscriber_holdsUpNeitherPublisherNorTheOthers() throws Exception {
        try (var slow = ActorSpace.create(SpaceSettings.named("slow"));
                var quick = ActorSpace.create(SpaceSettings.named("quick"))) {
            Topic<Integer> count = Topic.of(quick, "count");
            var stuck = new CountDownLatch(1);
            var goOn = new CountDownLatch(1);
            var heardQuickly = new CountDownLatch(1_000);
            var heardSlowly = new CountDownLatch(1_000);
            var subscribed = new CountDownLatch(1);
            slow.execute(() -> {
                count.subscribe(value -> {
                    stuck.countDown();
                    await(goOn); // if it is interrupted, it throws and does not count
                    heardSlowly.countDown();
                });
                subscribed.countDown();
            });
            awaitInTime(subscribed);
            count.subscribe(value -> heardQuickly.countDown());
            count.publish(0);
            awaitInTime(stuck);
            for (int i = 1; i < 1_000; i++) {
                assertThat(count.publish(i)).isEqualTo(2);
            }
            awaitInTime(heardQuickly);
            assertThat(heardSlowly.getCount()).isEqualTo(1_000);
            goOn.countDown();
            awaitInTime(heardSlowly);
        }
    }
}
