package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;

import java.time.Duration;
import java.util.List;
import org.junit.jupiter.api.Test;

/** A service is started when it is needed, and not before. */
class StartOnDemandTest {
    @Test
    void register_startsNothing() {
        try (var bench = new BrokerBench()) {
            bench.offer("player", "p");
            bench.seconds(5);
            assertThat(bench.diary).isEmpty();
            assertThat(bench.health("p")).isEqualTo(Health.NOT_STARTED);
        }
    }

    @Test
    void concurrentNeeds_startItOnce_andGetTheSame() {
        try (var bench = new BrokerBench()) {
            var player = bench.offer("player", "p");
            player.start = player::hang;
            var first = bench.broker.require(Need.ofService("robot 1", "player"));
            var second = bench.broker.require(Need.ofService("robot 2", "player"));
            bench.test.crank();
            assertThat(first.isDone()).isFalse();
            assertThat(bench.health("p")).isEqualTo(Health.STARTING);
            player.unanswered.remove().resolve(null);
            assertThat(bench.test.get(first)).isEqualTo(bench.test.get(second));
            assertThat(bench.test.get(first).health()).isEqualTo(Health.WELL);
            assertThat(bench.diary).containsExactly("start p");
        }
    }

    @Test
    void whatRuns_isNotStartedAgain() {
        try (var bench = new BrokerBench()) {
            bench.offer("player", "p");
            bench.require("player");
            bench.require("player");
            assertThat(bench.diary).containsExactly("start p");
        }
    }

    @Test
    void startThatFails_throwsOrHangs_goesOnToTheNext() {
        try (var bench = new BrokerBench()) {
            var a = bench.offer("player", "a");
            var b = bench.offer("player", "b");
            var c = bench.offer("player", "c");
            bench.offer("player", "d");
            a.start = a::fail;
            b.start = b::explode;
            c.start = c::hang;
            var need = bench.broker.require(Need.ofService("robot 1", "player"));
            bench.pass(Duration.ofSeconds(10));
            assertThat(bench.test.get(need).provider()).isEqualTo(BrokerBench.at("d"));
            assertThat(bench.diary).containsExactly("start a", "start b", "start c", "stop c", "start d");
            assertThat(bench.events(BrokerEvent.StartFailed.class))
                    .extracting(event -> event.provider().provider().name() + ": " + Reasons.of(event.why()))
                    .containsExactly(
                            "a: java.lang.IllegalStateException: a is broken",
                            "b: java.lang.IllegalStateException: b exploded",
                            "c: node/c did not start within PT10S");
        }
    }

    @Test
    void noProviderLeft_isAnErrorThatNamesEachAndWhy() {
        try (var bench = new BrokerBench()) {
            var a = bench.offer("player", "a", "drives");
            var b = bench.offer("player", "b");
            a.start = a::fail;
            b.start = b::hang;
            var need = bench.broker.require(Need.ofService("robot 1", "player"));
            bench.pass(Duration.ofSeconds(10));
            assertThat(bench.missing(need))
                    .isEqualTo("\"robot 1\" needs the service \"player\", which is offered, but runs nowhere: "
                            + "node/a (java.lang.IllegalStateException: a is broken), node/b (node/b did not start within PT10S); "
                            + "registered: player (drives; failed), player (failed)");
        }
    }

    @Test
    void startThatComesLate_isReported_andStoppedAgain() {
        try (var bench = new BrokerBench()) {
            var a = bench.offer("player", "a");
            bench.offer("player", "b");
            a.start = a::hang;
            var need = bench.broker.require(Need.ofService("robot 1", "player"));
            bench.pass(Duration.ofSeconds(10));
            assertThat(bench.test.get(need).provider().name()).isEqualTo("b");
            a.unanswered.remove().resolve(null);
            bench.test.crank();
            assertThat(bench.events(BrokerEvent.Late.class))
                    .containsExactly(new BrokerEvent.Late("node/a", "start", null));
            assertThat(bench.diary).containsExactly("start a", "stop a", "start b", "stop a");
            assertThat(bench.health("a")).isEqualTo(Health.FAILED);
        }
    }

    @Test
    void failedProvider_isTriedAgainOnDemand_afterAllOthers() {
        try (var bench = new BrokerBench(BrokerSettings.DEFAULT.withoutRestart())) {
            var a = bench.offer("player", "a");
            a.start = a::fail;
            assertThat(bench.missing(bench.broker.require(Need.ofService("robot 1", "player"))))
                    .contains("a is broken");
            a.start = io.troupe.actor.promise.Promise::done;
            bench.seconds(100);
            assertThat(bench.diary).containsExactly("start a");
            bench.offer("player", "b");
            assertThat(bench.require("player").provider().name()).isEqualTo("b");
            bench.test.get(bench.broker.withdraw(BrokerBench.at("b")));
            assertThat(bench.require("player").provider().name()).isEqualTo("a");
        }
    }

    @Test
    void withdrawnWhileItStarts_isStopped_andTheNextIsUsed() {
        try (var bench = new BrokerBench()) {
            var a = bench.offer("player", "a");
            bench.offer("player", "b");
            a.start = a::hang;
            var need = bench.broker.require(Need.ofService("robot 1", "player"));
            var withdrawn = bench.broker.withdraw(BrokerBench.at("a"));
            bench.test.crank();
            a.unanswered.remove().resolve(null);
            assertThat(bench.test.get(need).provider().name()).isEqualTo("b");
            bench.test.crank();
            assertThat(withdrawn.isDone()).isTrue();
            assertThat(bench.diary).containsExactlyInAnyOrder("start a", "stop a", "start b");
            assertThat(bench.test.get(bench.broker.registered()))
                    .extracting(each -> each.provider().name())
                    .isEqualTo(List.of("b"));
        }
    }
}
