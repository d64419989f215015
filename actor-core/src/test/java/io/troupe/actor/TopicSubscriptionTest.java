package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.TopicTest.Robot;
import io.troupe.actor.testkit.CallbackProbe;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** Subscribing to a topic, and when subscriptions are removed. */
class TopicSubscriptionTest {
    private final TestSpace test = new TestSpace();
    private final TestSpace elsewhere = new TestSpace();
    private final Topic<Integer> topic = Topic.of(test.space(), "range");
    private final List<String> log = new ArrayList<>();

    /** Passes its callbacks on to a topic. */
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
    void cancelledSubscription_receivesNothingMore_notEvenWhatWasSent() {
        var subscription = topic.subscribe(value -> log.add("heard " + value));
        topic.publish(1);
        subscription.cancel();
        test.crank();
        assertThat(topic.publish(2)).isZero();
        test.crank();
        assertThat(log).isEmpty();
    }

    @Test
    void cancelledSubscriptions_areRemoved_withoutAPublisher() {
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
        Robot robot = test.space()
                .spawn(
                        Robot.class,
                        () -> new Robot(() -> topic.subscribe(value -> log.add("heard " + value))),
                        ActorSettings.DEFAULT.withSupervision(Supervision.STOP));
        robot.act(() -> {
            assertThat(topic.publish(2)).as("it has not stopped yet").isOne();
            throw new IllegalStateException("on purpose"); // ends it before the next entry
        });
        test.crank();
        assertThat(test.takeProblems()).hasSize(1);
        assertThat(log).isEmpty();
    }

    @Test
    void restartedActor_subscribesAnew_andReceivesOnce() {
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
    void callbackThatAnActorWasHanded_runsWhereItsReaderIs_andIsForgottenWithIt() {
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
    void callbackThatAnotherSenderHasEnded_isNoErrorOfThePublisher() {
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
}
