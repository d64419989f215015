package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.testkit.CallbackProbe;
import io.troupe.actor.testkit.TestSpace;
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

    /** Runs the tasks of the test as an actor. */
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

    private Robot robotThat(TestSpace where, Runnable first) {
        return where.spawn(Robot.class, () -> new Robot(first));
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
    void subscriber_receivesOnItsSpace_inTheCallbackQueue_neverOnThePublishersStack() {
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
    void spaces_receiveEachOnItsThread_andASlowOneHoldsUpNobody() {
        robotThat(test, () -> topic.subscribe(value -> log.add("here " + value)));
        robotThat(elsewhere, () -> topic.subscribe(value -> log.add("there " + value)));
        assertThat(topic.publish(1) + topic.publish(2)).isEqualTo(4);
        test.crank();
        assertThat(log).containsExactly("here 1", "here 2");
        elsewhere.crank();
        assertThat(log).containsExactly("here 1", "here 2", "there 1", "there 2");
    }

    @Test
    void value_withoutSubscribers_isNotSent() {
        assertThat(topic.publish(1)).isZero();
        topic.subscribe(value -> log.add("heard " + value));
        test.crank();
        assertThat(log).isEmpty();
    }

    @Test
    void lateSubscriber_ofALatestTopic_receivesTheLastValueFirst() {
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
    void subscriber_maySubscribeAndCancelAndPublish_whileItReceives() {
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
    void null_isRejected() {
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

    @Test
    void methodReference_thatWouldFitBothMethods_subscribesToTheValues() {
        Topic<String> names = Topic.of(test.space(), "names");
        names.subscribe(log::add);
        CallbackProbe<String> first = test.callback();
        CallbackProbe<String> second = test.callback();
        names.subscribe(first, second);
        assertThat(names.publish("Ann")).isEqualTo(3);
        test.crank();
        assertThat(log).containsExactly("Ann");
        assertThat(first.results()).containsExactly("Ann");
        assertThat(second.results()).containsExactly("Ann");
    }
}
