package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Promise;
import java.time.Duration;
import org.junit.jupiter.api.Test;

/** Running providers are checked; clients of a failed provider get another one. */
class HealthTest {
    @Test
    void providerThatHangs_isSuspect_thenFailed_andItsUsersGoOver() {
        try (var bench = new BrokerBench()) {
            var a = bench.offer("player", "a");
            bench.offer("player", "b");
            var heard = bench.connect("robot 1", "player");
            a.check = a::hang;
            bench.seconds(2); // check after one second, limit after another
            assertThat(bench.health("a")).isEqualTo(Health.SUSPECT);
            bench.seconds(3);
            assertThat(bench.health("a")).isEqualTo(Health.SUSPECT);
            assertThat(heard).containsExactly("use a");
            bench.seconds(1);
            assertThat(bench.health("a")).isEqualTo(Health.FAILED);
            assertThat(heard).containsExactly("use a", "use b");
            assertThat(bench.diary)
                    .containsExactly("start a", "robot 1 hears of a", "stop a", "start b", "robot 1 hears of b");
            assertThat(bench.events(BrokerEvent.FailedOver.class))
                    .extracting(event ->
                            event.from().provider() + " > " + event.to().provider())
                    .containsExactly("node/a > node/b");
        }
    }

    @Test
    void suspect_thatAnswers_isWellAgain_andItsMissesAreForgotten() {
        try (var bench = new BrokerBench()) {
            var a = bench.offer("player", "a");
            bench.require("player");
            for (int i = 0; i < 3; i++) {
                a.check = a::hang;
                bench.seconds(4); // two checks missed
                assertThat(bench.health("a")).isEqualTo(Health.SUSPECT);
                a.check = Promise::done;
                bench.seconds(1);
                assertThat(bench.health("a")).isEqualTo(Health.WELL);
            }
            assertThat(bench.events(BrokerEvent.Suspect.class)).hasSize(3);
            assertThat(bench.events(BrokerEvent.Recovered.class)).hasSize(3);
        }
    }

    @Test
    void answerToACheck_thatComesLate_isReported_andDoesNotCount() {
        try (var bench = new BrokerBench()) {
            var a = bench.offer("player", "a");
            bench.require("player");
            a.check = a::hang;
            bench.seconds(2);
            a.unanswered.remove().resolve(null);
            bench.test.crank();
            assertThat(bench.events(BrokerEvent.Late.class))
                    .containsExactly(new BrokerEvent.Late("node/a", "check", null));
            assertThat(bench.health("a")).isEqualTo(Health.SUSPECT);
        }
    }

    @Test
    void providerThatSaysItIsUnwell_orThrows_hasFailedAtOnce() {
        try (var bench = new BrokerBench()) {
            var a = bench.offer("player", "a");
            var b = bench.offer("player", "b");
            bench.offer("player", "c");
            var heard = bench.connect("robot 1", "player");
            a.check = a::fail;
            bench.seconds(1);
            assertThat(heard).containsExactly("use a", "use b");
            b.check = b::explode;
            bench.seconds(1);
            assertThat(heard).containsExactly("use a", "use b", "use c");
            assertThat(bench.events(BrokerEvent.Failed.class))
                    .extracting(event -> event.provider().provider().name() + ": "
                            + event.why().getMessage())
                    .containsExactly("a: a is broken", "b: b exploded");
        }
    }

    @Test
    void providerThatDies_isNoticedWithoutACheck_andFailoverGoesThroughAllThree() {
        try (var bench = new BrokerBench(BrokerSettings.DEFAULT.withoutRestart())) {
            var a = bench.offer("player", "a");
            var b = bench.offer("player", "b");
            var c = bench.offer("player", "c");
            var heard = bench.connect("robot 1", "player");
            a.die("power");
            bench.test.crank();
            b.die("power");
            bench.test.crank();
            c.die("power");
            bench.test.crank();
            assertThat(heard).containsExactly("use a", "use b", "use c", "lost");
            assertThat(bench.diary).doesNotContain("stop a", "stop b", "stop c"); // they have ended
            assertThat(bench.events(BrokerEvent.Lost.class).getFirst().why())
                    .hasMessageContaining("node/a (java.lang.IllegalStateException: power), node/b (");
            bench.seconds(200);
            assertThat(heard).hasSize(4);
            assertThat(bench.require("player").provider().name()).isEqualTo("a"); // on demand
            bench.test.crank();
            assertThat(heard).containsExactly("use a", "use b", "use c", "lost", "use a");
            assertThat(bench.events(BrokerEvent.Connected.class)).hasSize(2); // at first, and after the loss
            assertThat(bench.events(BrokerEvent.FailedOver.class)).hasSize(2);
        }
    }

    @Test
    void failedProvider_isStartedAgainWhileAConnectionWaits_afterPausesThatGrow() {
        try (var bench =
                new BrokerBench(BrokerSettings.DEFAULT.withRestart(Duration.ofSeconds(1), Duration.ofSeconds(4)))) {
            var a = bench.offer("player", "a");
            var heard = bench.connect("robot 1", "player");
            a.start = a::fail;
            a.die("power");
            bench.test.crank();
            bench.diary.clear();
            bench.seconds(1 + 2 + 4 + 4);
            assertThat(bench.diary).containsExactly("start a", "start a", "start a", "start a");
            a.start = Promise::done;
            bench.seconds(3);
            assertThat(heard).containsExactly("use a", "lost");
            bench.seconds(1);
            assertThat(heard).containsExactly("use a", "lost", "use a");
            bench.seconds(4); // the pauses start at the shortest again
            a.die("again");
            bench.seconds(1);
            assertThat(heard).containsExactly("use a", "lost", "use a", "lost", "use a");
        }
    }

    @Test
    void providerThatFailsSoonAfterEachGoodCheck_isStartedAgainAfterPausesThatGrow() {
        try (var bench =
                new BrokerBench(BrokerSettings.DEFAULT.withRestart(Duration.ofSeconds(1), Duration.ofSeconds(4)))) {
            var a = bench.offer("player", "a");
            var heard = bench.connect("robot 1", "player");
            for (int pauseSeconds : new int[] {1, 2, 4, 4}) {
                bench.seconds(1); // a good check
                a.die("power");
                bench.test.crank();
                heard.clear();
                bench.seconds(pauseSeconds - 1);
                assertThat(heard)
                        .as("after %d s of %d s", pauseSeconds - 1, pauseSeconds)
                        .isEmpty();
                bench.seconds(1);
                assertThat(heard).as("after %d s", pauseSeconds).containsExactly("use a");
            }
        }
    }

    @Test
    void failedProvider_thatNobodyWaitsFor_isLeftAlone() {
        try (var bench = new BrokerBench()) {
            var a = bench.offer("player", "a");
            bench.offer("player", "b");
            bench.connect("robot 1", "player");
            a.die("power");
            bench.seconds(200);
            assertThat(bench.diary).filteredOn("start a"::equals).hasSize(1);
        }
    }

    @Test
    void restart_waitsForTheStopOfTheLifeBefore_orItsLimit() {
        try (var bench = new BrokerBench(BrokerSettings.DEFAULT.withoutRestart())) {
            var a = bench.offer("player", "a");
            bench.require("player");
            a.check = a::fail;
            a.stop = a::hang;
            bench.seconds(1);
            a.check = Promise::done;
            var again = bench.broker.require(Need.ofService("robot 1", "player"));
            bench.seconds(4);
            assertThat(again.isDone()).isFalse();
            bench.seconds(1);
            assertThat(bench.test.get(again).health()).isEqualTo(Health.WELL);
            assertThat(bench.diary).containsExactly("start a", "stop a", "start a");
            assertThat(bench.events(BrokerEvent.StopFailed.class))
                    .extracting(event -> event.why().getMessage())
                    .containsExactly("node/a did not stop within PT5S");
            a.stop = Promise::done;
        }
    }

    @Test
    void observerThatThrows_isReported_andChangesNothing() {
        var test = new io.troupe.actor.testkit.TestSpace();
        var broker = Broker.open(test.space(), BrokerSettings.DEFAULT.withObserver(event -> {
            throw new IllegalStateException("observer");
        }));
        var diary = new java.util.ArrayList<String>();
        test.get(broker.register("player", java.util.List.of(), BrokerBench.at("p"), new FakeProvider("p", diary)));
        assertThat(test.get(broker.require(Need.ofService("x", "player"))).health())
                .isEqualTo(Health.WELL);
        assertThat(test.takeProblems()).hasSize(3); // registered, starting, started
        test.get(broker.shutDown());
        test.takeProblems();
        test.close();
    }
}
