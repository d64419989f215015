package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.TopicTest.Robot;
import io.troupe.actor.testkit.CallbackProbe;
import io.troupe.actor.testkit.TestSpace;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

class TopicEndTest {
    private final TestSpace test = new TestSpace();
    private final Topic<Integer> topic = Topic.of(test.space(), "range");
    private final Topic<Integer> latest = Topic.latest(test.space(), "last range");

    @AfterEach
    void nothingIsLeft() {
        test.close();
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
    void subscriberAfterTheEnd_isNotifiedOfTheEndOnly() {
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
        test.spawn(Robot.class, () -> new Robot(() -> topic.subscribe(value -> {})));
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
}
