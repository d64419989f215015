package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Promise;
import java.time.Duration;
import org.junit.jupiter.api.Test;

/** Starts that complete when a later run has begun or ended: the provider must not keep running because of them. */
class LateStartTest {
    private static BrokerBench bench() {
        return new BrokerBench(BrokerSettings.DEFAULT.withoutRestart());
    }

    /** Starts a provider whose start exceeds the limit. */
    private static FakeProvider overdue(BrokerBench bench) {
        var a = bench.offer("player", "a");
        a.start = a::hang;
        var first = bench.broker.require(Need.ofService("robot 1", "player"));
        bench.seconds(10);
        bench.missing(first);
        assertThat(bench.diary).containsExactly("start a", "stop a");
        return a;
    }

    @Test
    void answeredAfterALaterRunHasFailed_isStopped() {
        try (var bench = bench()) {
            var a = overdue(bench);
            a.start = a::fail;
            bench.missing(bench.broker.require(Need.ofService("robot 1", "player")));
            a.unanswered.remove().resolve(null);
            bench.test.crank();
            assertThat(bench.diary).containsExactly("start a", "stop a", "start a", "stop a");
        }
    }

    @Test
    void answeredAfterALaterRunWasStopped_isStopped() {
        try (var bench = bench()) {
            var a = overdue(bench);
            a.start = Promise::done;
            bench.require("player");
            bench.test.get(bench.broker.withdraw(BrokerBench.at("a")));
            a.unanswered.remove().resolve(null);
            bench.test.crank();
            assertThat(bench.diary).containsExactly("start a", "stop a", "start a", "stop a", "stop a");
        }
    }

    @Test
    void answeredWhileALaterRunStarts_isStopped_ifThatFails() {
        try (var bench = bench()) {
            var a = overdue(bench);
            var second = bench.broker.require(Need.ofService("robot 1", "player"));
            bench.test.crank();
            a.unanswered.removeFirst().resolve(null);
            bench.test.crank();
            assertThat(bench.diary)
                    .as("it goes on if the second start succeeds")
                    .endsWith("stop a", "start a");
            a.unanswered.removeFirst().reject(new IllegalStateException("not twice"));
            bench.missing(second);
            bench.test.crank();
            assertThat(bench.diary).containsExactly("start a", "stop a", "start a", "stop a");
        }
    }

    @Test
    void answeredWhileALaterRunStarts_isOneLifeWithIt_ifThatSucceeds() {
        try (var bench = bench()) {
            var a = overdue(bench);
            var second = bench.broker.require(Need.ofService("robot 1", "player"));
            bench.test.crank();
            a.unanswered.removeFirst().resolve(null);
            bench.test.crank();
            a.unanswered.removeFirst().resolve(null);
            assertThat(bench.test.get(second).health()).isEqualTo(Health.WELL);
            bench.test.get(bench.broker.withdraw(BrokerBench.at("a")));
            assertThat(bench.diary).containsExactly("start a", "stop a", "start a", "stop a");
        }
    }

    @Test
    void answeredWhileItIsBeingStopped_isStoppedOnceMore_beforeItIsStartedAgain() {
        try (var bench = bench()) {
            var a = bench.offer("player", "a");
            a.start = a::hang;
            a.stop = a::hang;
            bench.broker.require(Need.ofService("robot 1", "player")).handle((record, error) -> null);
            bench.seconds(10);
            var again = bench.broker.require(Need.ofService("robot 1", "player"));
            bench.test.crank();
            a.unanswered.removeFirst().resolve(null); // the start
            bench.test.crank();
            a.start = Promise::done;
            a.stop = Promise::done;
            a.unanswered.removeFirst().resolve(null); // the stop, which may have been executed before the start
            assertThat(bench.test.get(again).health()).isEqualTo(Health.WELL);
            assertThat(bench.diary).containsExactly("start a", "stop a", "stop a", "start a");
        }
    }

    @Test
    void answeredWhileItIsBeingStopped_aLateAnswerToThatStopDoesNotCount() {
        var bench = bench();
        var a = bench.offer("player", "a");
        a.start = a::hang;
        a.stop = a::hang;
        bench.broker.require(Need.ofService("robot 1", "player")).handle((record, error) -> null);
        bench.seconds(10);
        a.unanswered.removeFirst().resolve(null); // the start: it runs now
        bench.seconds(10); // the first stop is overdue; it is stopped once more
        a.unanswered.removeFirst().resolve(null); // the first stop, which may have been executed before the start
        bench.seconds(10); // the second stop is overdue, too: it may still run
        a.stop = Promise::done;
        assertThat(bench.test.get(bench.broker.shutDown())).isEmpty();
        assertThat(bench.diary).containsExactly("start a", "stop a", "stop a", "stop a");
    }

    @Test
    void answeredAfterShutDown_isStopped() {
        var bench = bench();
        var a = overdue(bench);
        assertThat(bench.test.get(bench.broker.shutDown())).isEmpty();
        a.unanswered.remove().resolve(null);
        bench.pass(Duration.ofSeconds(1));
        assertThat(bench.diary).containsExactly("start a", "stop a", "stop a");
        bench.test.close();
    }
}
