package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.testkit.CallbackProbe;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

class TopicTest {
    private final TestSpace test = new TestSpace();
    private final TestSpace elsewhere = new TestSpace();
    private final Topic<Integer> topic = Topic.of(test.space(), "range");
    private final Topic<Integer> latest = Topic.latest(test.space(), "last range");
    private final List<String> log = new ArrayList<>();

    /** Does what the test tells it to, as an actor. */
    public static class Robot extends Actor {
        private final @Nullable Runnable first;

        Robot(@Nullable Runnable first) {
            this.first = first;
        }

        @Override
        protected void started() {
            if (first != null) {
                first.run();
            }
        }

        public void act(Runnable action) {
            action.run();
        }
    }

    /** Hands its readers on to a topic. */
    interface Sensor {
        void readings(Callback<Integer> readings);
    }

    private Robot robotThat(TestSpace where, Runnable first) {
        return where.spawn(Robot.class, () -> new Robot(first));
    }

    private void crankBoth() {
        test.crank();
        elsewhere.crank();
    }

    private String here() {
        return ActorSpace.current() == elsewhere.space() ? "elsewhere" : "test";
    }

    @AfterEach
    void nothingIsLeft() {
        test.close();
        elsewhere.close();
    }

    @Test
    void values_reachEverySubscriber_inTheOrderInWhichTheyWerePublished() {
        topic.subscribe(value -> log.add("a" + value));
        topic.subscribe((value, error) -> log.add("b" + value));
        assertThat(topic.publish(1)).isEqualTo(2);
        assertThat(topic.publish(2)).isEqualTo(2);
        assertThat(log).isEmpty();
        test.crank();
        assertThat(log).containsExactly("a1", "b1", "a2", "b2");
    }

    @Test
    void subscriber_hearsOnItsOwnSpace_inTheCallbackQueue_neverOnThePublishersStack() {
        Robot robot = robotThat(elsewhere, () -> {});
        robot.act(() -> {
            topic.subscribe(value -> log.add(value + " in " + here()));
            robot.act(() -> log.add("mail"));
            log.add("sent to " + topic.publish(7));
        });
        elsewhere.crank();
        assertThat(log).containsExactly("sent to 1", "7 in elsewhere", "mail");
        log.clear();
        topic.publish(8);
        test.crank();
        assertThat(log).as("heard in the publisher's space").isEmpty();
        elsewhere.crank();
        assertThat(log).containsExactly("8 in elsewhere");
    }

    @Test
    void spaces_hearEachOnItsOwn_andASlowOneHoldsUpNobody() {
        robotThat(test, () -> topic.subscribe(value -> log.add("here " + value)));
        robotThat(elsewhere, () -> topic.subscribe(value -> log.add("there " + value)));
        assertThat(topic.publish(1) + topic.publish(2)).isEqualTo(4);
        test.crank();
        assertThat(log).containsExactly("here 1", "here 2");
        elsewhere.crank();
        assertThat(log).containsExactly("here 1", "here 2", "there 1", "there 2");
    }

    @Test
    void value_nobodySubscribesTo_isSentToNobody() {
        assertThat(topic.publish(1)).isZero();
        topic.subscribe(value -> log.add("heard " + value));
        test.crank();
        assertThat(log).isEmpty();
    }

    @Test
    void lateSubscriber_ofALatestTopic_hearsTheLastValueFirst() {
        latest.subscribe(value -> log.add("early " + value));
        latest.publish(1);
        latest.publish(2);
        latest.subscribe(value -> log.add("late " + value));
        latest.publish(3);
        test.crank();
        assertThat(log).containsExactly("early 1", "early 2", "late 2", "early 3", "late 3");
    }

    @Test
    void latestTopic_remembersWhatNobodyHeard() {
        assertThat(latest.publish(5)).isZero();
        CallbackProbe<Integer> probe = test.callback();
        latest.subscribe(probe);
        assertThat(probe.results()).containsExactly(5);
    }

    @Test
    void cancelledSubscription_hearsNothingMore_notEvenWhatWasSent() {
        var subscription = topic.subscribe(value -> log.add("heard " + value));
        topic.publish(1);
        subscription.cancel();
        test.crank();
        assertThat(topic.publish(2)).isZero();
        test.crank();
        assertThat(log).isEmpty();
    }

    @Test
    void cancelledSubscriptions_areForgotten_withoutAPublisher() {
        for (int i = 0; i < 1_000; i++) {
            topic.subscribe(value -> log.add("heard " + value)).cancel();
        }
        topic.subscribe(value -> {});
        assertThat(topic.remembered()).isOne();
        assertThat(topic.subscribers()).isOne();
    }

    @Test
    void subscriberThatHasStopped_isForgotten_withoutAPublisher() {
        for (int i = 0; i < 100; i++) {
            Robot robot = robotThat(test, () -> topic.subscribe(value -> log.add("heard " + value)));
            assertThat(topic.subscribers()).isOne();
            test.space().stop(robot);
            test.crank();
            assertThat(topic.remembered()).as("the one that has just stopped").isOne();
        }
        assertThat(topic.publish(1)).isZero();
        assertThat(topic.remembered()).isZero();
        test.crank();
        assertThat(log).isEmpty();
    }

    @Test
    void valueOnItsWay_toASubscriberThatStops_isDropped() {
        Robot robot = robotThat(test, () -> topic.subscribe(value -> log.add("heard " + value)));
        test.space().stop(robot);
        assertThat(topic.publish(2)).as("it has not stopped yet").isOne();
        test.crank();
        assertThat(log).isEmpty();
    }

    @Test
    void restartedActor_subscribesAnew_andHearsOnce() {
        var settings = ActorSettings.DEFAULT.withSupervision(Supervision.restart(3, Duration.ofSeconds(10)));
        Robot robot = test.space()
                .spawn(
                        Robot.class,
                        () -> new Robot(() -> topic.subscribe(value -> log.add("heard " + value))),
                        settings);
        robot.act(() -> {
            throw new IllegalStateException("on purpose");
        });
        test.crank();
        assertThat(test.takeProblems()).hasSize(1);
        assertThat(topic.publish(1)).isOne();
        test.crank();
        assertThat(log).containsExactly("heard 1");
    }

    @Test
    void subscriberInAClosedSpace_isForgotten_andItsCodeNeverRunsOnThePublishersThread() {
        try (var closed = new TestSpace()) {
            closed.run(() -> topic.subscribe(value -> log.add("no actor heard " + value)));
            robotThat(closed, () -> topic.subscribe(value -> log.add("an actor heard " + value)));
            assertThat(topic.subscribers()).isEqualTo(2);
        }
        topic.publish(1);
        assertThat(topic.publish(2)).isZero();
        assertThat(log).isEmpty();
    }

    @Test
    void callbackThatAnActorWasHanded_hearsWhereItsReaderIs_andIsForgottenWithIt() {
        Sensor sensor = test.spawn(Sensor.class, () -> topic::subscribe);
        Robot robot = robotThat(elsewhere, () -> sensor.readings((value, error) -> log.add(value + " in " + here())));
        crankBoth();
        topic.publish(3);
        test.crank();
        assertThat(log).isEmpty();
        elsewhere.crank();
        assertThat(log).containsExactly("3 in elsewhere");
        elsewhere.space().stop(robot);
        elsewhere.crank();
        assertThat(topic.publish(4)).isZero();
    }

    @Test
    void callbackThatSomebodyElseHasEnded_isNoErrorOfThePublisher() {
        var kept = new ArrayList<Callback<Integer>>();
        Sensor sensor = test.spawn(Sensor.class, () -> readings -> {
            kept.add(readings);
            topic.subscribe(readings);
        });
        CallbackProbe<Integer> probe = test.callback();
        sensor.readings(probe);
        test.crank();
        kept.getFirst().finish();
        assertThat(topic.publish(1)).isZero();
        assertThat(topic.finish()).isTrue();
        assertThat(probe.results()).isEmpty();
        probe.expectFinished();
    }

    @Test
    void finish_endsEverySubscription_afterTheValuesBefore() {
        CallbackProbe<Integer> first = test.callback();
        CallbackProbe<Integer> second = test.callback();
        latest.subscribe(first);
        latest.subscribe(second);
        latest.publish(1);
        assertThat(latest.finish()).isTrue();
        assertThat(first.results()).containsExactly(1);
        first.expectFinished();
        second.expectFinished();
        assertThat(latest.publish(2)).isZero();
        assertThat(latest.subscribers()).isZero();
        assertThat(first.results()).containsExactly(1);
    }

    @Test
    void fail_endsEverySubscription_andOnlyTheFirstEndCounts() {
        CallbackProbe<Integer> probe = test.callback();
        topic.subscribe(probe);
        var unplugged = new IllegalStateException("unplugged");
        assertThat(topic.fail(unplugged)).isTrue();
        assertThat(topic.fail(new IllegalStateException("again"))).isFalse();
        assertThat(topic.finish()).isFalse();
        assertThat(probe.expectFailed()).isSameAs(unplugged);
    }

    @Test
    void subscriberAfterTheEnd_hearsOfTheEndOnly() {
        latest.publish(1);
        latest.finish();
        var unplugged = new IllegalStateException("unplugged");
        topic.fail(unplugged);
        CallbackProbe<Integer> probe = test.callback();
        CallbackProbe<Integer> ofTheFailed = test.callback();
        latest.subscribe(probe);
        topic.subscribe(ofTheFailed);
        assertThat(probe.results()).isEmpty();
        probe.expectFinished();
        assertThat(ofTheFailed.expectFailed()).isSameAs(unplugged);
        assertThat(latest.remembered()).isZero();
    }

    @Test
    void failure_ofATopic_isTheFailureOfASubscriberThatTakesValuesOnly() {
        var unplugged = new IllegalStateException("unplugged");
        robotThat(test, () -> topic.subscribe(value -> {}));
        topic.fail(unplugged);
        test.crank();
        assertThat(test.takeProblems()).singleElement().satisfies(problem -> {
            assertThat(problem.where()).contains("Robot#1");
            assertThat(problem.error())
                    .isInstanceOf(ActorException.class)
                    .hasMessageContaining("topic range has failed")
                    .hasCause(unplugged);
        });
    }

    @Test
    void subscriberThatThrows_failsAlone_andStaysSubscribed() {
        robotThat(
                test,
                () -> topic.subscribe(value -> {
                    throw new IllegalStateException("cannot use " + value);
                }));
        topic.subscribe(value -> log.add("heard " + value));
        topic.publish(1);
        test.crank();
        assertThat(topic.publish(2)).isEqualTo(2);
        test.crank();
        assertThat(log).containsExactly("heard 1", "heard 2");
        assertThat(test.takeProblems())
                .extracting(problem -> problem.error().getMessage())
                .containsExactly("cannot use 1", "cannot use 2");
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
        topic.subscribe(value -> log.add("heard " + value));
        assertThat(topic.publish(1)).isOne();
        test.crank();
        assertThat(log).containsExactly("heard 1");
        assertThat(test.takeProblems())
                .singleElement()
                .satisfies(problem ->
                        assertThat(problem.where()).isEqualTo("isCancelled() of a subscriber of topic range"));
    }

    @Test
    void subscriber_maySubscribeAndCancelAndPublish_whileItHears() {
        var subscription = new ArrayList<Callback.Stream<Integer>>();
        subscription.add(topic.subscribe(value -> {
            log.add("first " + value);
            subscription.getFirst().cancel();
            topic.subscribe(later -> log.add("second " + later));
            topic.publish(value + 1);
        }));
        topic.publish(1);
        test.crank();
        assertThat(log).containsExactly("first 1", "second 2");
        assertThat(topic.subscribers()).isOne();
    }

    /** A space serves what its own thread has queued before what others have queued a moment earlier: a topic keeps its order nevertheless. */
    @Test
    void valuesAndEnd_fromTheSubscribersOwnThread_doNotOvertakeThoseFromAnother() {
        topic.subscribe((value, error) -> log.add(error == null ? "heard " + value : error.getMessage()));
        test.run(() -> {
            onAnotherThread(() -> topic.publish(1));
            topic.publish(2);
            onAnotherThread(() -> topic.publish(3));
            topic.fail(new IllegalStateException("the end"));
        });
        assertThat(log).containsExactly("heard 1", "heard 2", "heard 3", "the end");
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

    private static void onAnotherThread(Runnable task) {
        Thread thread = Thread.ofPlatform().start(task);
        try {
            thread.join();
        } catch (InterruptedException e) {
            throw new AssertionError("interrupted while another thread worked", e);
        }
    }

    @Test
    void null_isRefused() {
        assertThatThrownBy(() -> topic.publish(null))
                .isInstanceOf(NullPointerException.class)
                .hasMessage("value");
        assertThatThrownBy(() -> topic.fail(null))
                .isInstanceOf(NullPointerException.class)
                .hasMessage("error");
        assertThatThrownBy(() -> topic.subscribe((Callback<Integer>) null))
                .isInstanceOf(NullPointerException.class)
                .hasMessage("callback");
    }
}
