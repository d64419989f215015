package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.atomic.AtomicBoolean;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** Replacing and withdrawing providers, and closing the broker, at run time. */
class ReplaceTest {
    private static Promise<ServiceRecord> replace(BrokerBench bench, String old, FakeProvider by, String name) {
        return bench.broker.replace(BrokerBench.at(old), "player", List.of("better"), BrokerBench.at(name), by);
    }

    @Test
    void replace_startsTheNew_tellsTheUsers_stopsTheOld_inThisOrder() {
        try (var bench = new BrokerBench()) {
            bench.offer("player", "a");
            bench.offer("player", "z");
            var heard = bench.connect("robot 1", "player");
            bench.connect("robot 2", "player");
            var record = bench.test.get(replace(bench, "a", bench.provider("b"), "b"));
            assertThat(record.health()).isEqualTo(Health.WELL);
            assertThat(record.capabilities()).containsExactly("better");
            assertThat(heard).containsExactly("use a", "use b");
            assertThat(bench.diary)
                    .containsExactly(
                            "start a",
                            "robot 1 hears of a",
                            "robot 2 hears of a",
                            "start b",
                            "robot 1 hears of b",
                            "robot 2 hears of b",
                            "stop a");
            assertThat(bench.test.get(bench.broker.registered()))
                    .extracting(each -> each.provider().name())
                    .containsExactly("b", "z");
        }
    }

    @Test
    void replacement_mayHaveTheAddressOfTheOld() {
        try (var bench = new BrokerBench()) {
            bench.offer("player", "a");
            var heard = bench.connect("robot 1", "player");
            bench.test.get(replace(bench, "a", bench.provider("a'"), "a"));
            assertThat(heard).containsExactly("use a", "use a");
            assertThat(bench.diary)
                    .containsExactly("start a", "robot 1 hears of a", "start a'", "robot 1 hears of a", "stop a");
        }
    }

    @Test
    void replacementThatDoesNotStart_isRefused_andTheOldStaysInUse() {
        try (var bench = new BrokerBench()) {
            bench.offer("player", "a");
            var heard = bench.connect("robot 1", "player");
            var b = bench.provider("b");
            b.start = b::fail;
            assertThat(bench.test.error(replace(bench, "a", b, "b")))
                    .isInstanceOf(ProviderException.class)
                    .hasMessage("node/b could not be started in the place of node/a, which stays in use: "
                            + "java.lang.IllegalStateException: b is broken");
            b.start = b::hang;
            var second = replace(bench, "a", b, "b");
            bench.seconds(10);
            assertThat(bench.test.error(second)).hasMessageEndingWith("node/b did not start within PT10S");
            assertThat(heard).containsExactly("use a");
            assertThat(bench.health("a")).isEqualTo(Health.WELL);
            assertThat(bench.test.get(bench.broker.registered())).hasSize(1);
            b.start = Promise::done;
            bench.test.get(replace(bench, "a", b, "b")); // its address is free again
        }
    }

    @ParameterizedTest
    @CsvSource({"b, c", "a, a", "a, c"})
    void secondReplacement_whileTheFirstStarts_isRefused_andOnlyOneRuns(String first, String second) {
        try (var bench = new BrokerBench()) {
            bench.offer("player", "a");
            var heard = bench.connect("robot 1", "player");
            var by = bench.provider("first");
            by.start = by::hang;
            var replaced = replace(bench, "a", by, first);
            bench.test.crank();
            assertThat(bench.test.error(replace(bench, "a", bench.provider("second"), second)))
                    .isInstanceOf(IllegalStateException.class)
                    .hasMessage("node/a is being replaced already, expected one replacement at a time");
            by.unanswered.remove().resolve(null);
            assertThat(bench.test.get(replaced).provider()).isEqualTo(BrokerBench.at(first));
            assertThat(bench.test.get(bench.broker.registered())).hasSize(1);
            assertThat(heard).containsExactly("use a", "use " + first);
            assertThat(bench.diary).contains("start first", "stop a").doesNotContain("start second");

            var third = bench.provider("third"); // one after the other
            bench.test.get(replace(bench, first, third, second));
            assertThat(bench.test.get(bench.broker.registered())).hasSize(1);
            assertThat(bench.diary).contains("start third", "stop first");
        }
    }

    @Test
    void oldThatDoesNotStop_isReported_andTheReplacementHolds() {
        try (var bench = new BrokerBench()) {
            var a = bench.offer("player", "a");
            var heard = bench.connect("robot 1", "player");
            a.stop = a::hang;
            var replaced = replace(bench, "a", bench.provider("b"), "b");
            bench.seconds(5);
            assertThat(bench.test.get(replaced).provider().name()).isEqualTo("b");
            assertThat(heard).containsExactly("use a", "use b");
            assertThat(bench.events(BrokerEvent.StopFailed.class))
                    .extracting(event -> event.provider().provider().name())
                    .containsExactly("a");
            a.unanswered.remove().resolve(null);
            bench.test.crank();
            assertThat(bench.events(BrokerEvent.Late.class))
                    .containsExactly(new BrokerEvent.Late("node/a", "stop", null));
        }
    }

    @Test
    void userThatThrows_orDoesNotReturn_doesNotHoldUpTheOthers() {
        try (var bench = new BrokerBench()) {
            bench.offer("player", "a");
            bench.broker.connect(Need.ofService("bad", "player"), new Broker.Connection() {
                @Override
                public void use(ServiceRecord provider) {
                    throw new IllegalStateException("no, thanks");
                }

                @Override
                public void lost(MissingServiceException why) {}
            });
            var heard = bench.connect("good", "player");
            bench.test.get(replace(bench, "a", bench.provider("b"), "b"));
            assertThat(heard).containsExactly("use a", "use b");
            assertThat(bench.events(BrokerEvent.UserFailed.class))
                    .extracting(event -> event.need().by() + ": " + event.why().getMessage())
                    .containsExactly("bad: no, thanks", "bad: no, thanks");
        }
    }

    @Test
    void userThatThrowsAnError_isReportedWithIt_andNotAsSlow() {
        try (var bench = new BrokerBench()) {
            bench.offer("player", "a");
            bench.broker.connect(Need.ofService("bad", "player"), new Broker.Connection() {
                @Override
                public void use(ServiceRecord provider) {
                    throw new AssertionError("no class for " + provider.provider());
                }

                @Override
                public void lost(MissingServiceException why) {}
            });
            bench.seconds(2);
            assertThat(bench.events(BrokerEvent.UserFailed.class))
                    .extracting(event -> event.why().getMessage())
                    .containsExactly("no class for node/a");
            assertThat(bench.test.takeProblems())
                    .extracting(problem -> problem.error().getMessage())
                    .containsExactly("no class for node/a");
        }
    }

    @Test
    void withdraw_givesUsersTheNext_thenStops_andTellsThoseForWhomThereIsNone() {
        try (var bench = new BrokerBench()) {
            bench.offer("player", "a");
            bench.offer("player", "b");
            var heard = bench.connect("robot 1", "player");
            bench.test.get(bench.broker.withdraw(BrokerBench.at("a")));
            bench.test.get(bench.broker.withdraw(BrokerBench.at("b")));
            assertThat(heard).containsExactly("use a", "use b", "lost");
            assertThat(bench.diary)
                    .containsExactly(
                            "start a",
                            "robot 1 hears of a",
                            "start b",
                            "robot 1 hears of b",
                            "stop a",
                            "robot 1 hears of the loss",
                            "stop b");
            bench.offer("player", "c");
            bench.test.crank();
            assertThat(heard).endsWith("use c");
        }
    }

    @Test
    void providerAtTheAddressOfAWithdrawnOne_isStartedWhenThatHasStopped() {
        try (var bench = new BrokerBench()) {
            var a = bench.offer("player", "a");
            bench.require("player");
            a.stop = a::hang;
            bench.broker.withdraw(BrokerBench.at("a"));
            var second = bench.provider("a2");
            bench.broker.register("player", List.of(), BrokerBench.at("a"), second);
            bench.broker.withdraw(BrokerBench.at("a")); // it never ran
            bench.broker.register("player", List.of(), BrokerBench.at("a"), bench.provider("a3"));
            var required = bench.broker.require(Need.ofService("x", "player"));
            bench.seconds(2);
            assertThat(bench.diary).containsExactly("start a", "stop a");
            assertThat(required.isDone()).isFalse();
            a.unanswered.remove().resolve(null);
            bench.test.get(required);
            assertThat(bench.diary).containsExactly("start a", "stop a", "start a3");
        }
    }

    @Test
    void withdrawnProvider_whoseUserWaitsForTheNextAtItsAddress_isStoppedFirst() {
        try (var bench = new BrokerBench(BrokerSettings.DEFAULT.withoutRestart())) {
            bench.offer("player", "a");
            var b = bench.offer("player", "b");
            var heard = bench.connect("robot 1", "player");
            b.start = b::hang;
            bench.broker.withdraw(BrokerBench.at("a")); // stopped when its client has another provider
            bench.broker.register("player", List.of(), BrokerBench.at("a"), bench.provider("a2"));
            bench.test.crank();
            assertThat(bench.diary).containsExactly("start a", "robot 1 hears of a", "start b");
            b.unanswered.remove().reject(new IllegalStateException("no"));
            bench.test.crank();
            assertThat(heard).containsExactly("use a", "use a");
            assertThat(bench.diary)
                    .containsExactly(
                            "start a", "robot 1 hears of a", "start b", "stop a", "start a2", "robot 1 hears of a");
        }
    }

    /**
     * A provider that may be running already when it is started again, like a component's interface: one stop ends it.
     */
    private static FakeProvider startedOnce(BrokerBench bench, String name, AtomicBoolean runs) {
        var provider = bench.provider(name);
        provider.start = () -> {
            runs.set(true);
            return Promise.done();
        };
        provider.stop = () -> {
            runs.set(false);
            return Promise.done();
        };
        return provider;
    }

    @ParameterizedTest
    @ValueSource(strings = {"a", "elsewhere"})
    void placeThatIsGivenBack_beforeTheUserIsNotified_isServedByANewLife(String address) {
        var runs = new AtomicBoolean();
        var turns = new ManualTurns();
        try (var bench = new BrokerBench();
                var busy = new TestSpace()) {
            var a = startedOnce(bench, "a", runs);
            bench.test.get(bench.broker.register("player", List.of(), BrokerBench.at("a"), a));
            busy.space().execute(() -> turns.connect(bench.broker));
            turns.crank(busy, bench);
            bench.test.get(bench.broker.registered());
            assertThat(turns.heard).containsExactly("use a");

            replace(bench, "a", bench.provider("b"), "b"); // the client's space is busy until it is cranked
            bench.test.crank();
            assertThat(bench.diary).containsExactly("start a", "start b");
            var givenBack = replace(bench, "b", a, address);
            bench.test.crank();
            turns.crank(busy, bench);
            bench.test.get(givenBack);
            assertThat(bench.diary).containsExactly("start a", "start b", "stop a", "start a", "stop b");
            assertThat(runs).isTrue();
            assertThat(turns.heard).containsExactly("use a", "use b", "use " + address);
            assertThat(bench.health(address)).isEqualTo(Health.WELL);
            bench.test.get(bench.broker.disconnect(turns.connection)); // the client is not cranked any more
        }
    }

    /** A client on a space that is cranked separately from the broker's. */
    private static final class ManualTurns {
        final List<String> heard = new ArrayList<>();
        final Broker.Connection connection = new Broker.Connection() {
            @Override
            public void use(ServiceRecord provider) {
                heard.add("use " + provider.provider().name());
            }

            @Override
            public void lost(MissingServiceException why) {
                heard.add("lost");
            }
        };

        void connect(Broker broker) {
            broker.connect(Need.ofService("robot 1", "player"), connection).handle((record, error) -> null);
        }

        void crank(TestSpace user, BrokerBench bench) {
            for (int i = 0; i < 5; i++) { // several round trips
                user.crank();
                bench.test.crank();
            }
        }
    }

    @Test
    void providerAtTheAddressOfAReplacedOne_isStartedWhenThatHasStopped() {
        try (var bench = new BrokerBench()) {
            var a = bench.offer("player", "a");
            bench.require("player");
            a.stop = a::hang;
            replace(bench, "a", bench.provider("b"), "b");
            bench.broker.register("second", List.of(), BrokerBench.at("a"), bench.provider("a2"));
            var required = bench.broker.require(Need.ofService("x", "second"));
            bench.seconds(2);
            assertThat(bench.diary).containsExactly("start a", "start b", "stop a");
            assertThat(required.isDone()).isFalse();
            a.unanswered.remove().resolve(null);
            bench.test.get(required);
            assertThat(bench.diary).containsExactly("start a", "start b", "stop a", "start a2");
        }
    }

    @ParameterizedTest
    @ValueSource(booleans = {false, true})
    void manyThatAreWithdrawn_whileTheFirstAtTheirAddressStops_takeNoStack(boolean needed) {
        try (var bench = new BrokerBench()) {
            var a = bench.offer("player", "a");
            bench.require("player");
            a.stop = a::hang;
            bench.broker.withdraw(BrokerBench.at("a"));
            int many = needed ? 2_000 : 20_000;
            int refused = 0;
            for (int i = 0; i < many; i++) {
                bench.broker.register("player", List.of(), BrokerBench.at("a"), bench.provider("passing"));
                var need = needed ? bench.broker.require(Need.ofService("x", "player")) : null;
                bench.broker.withdraw(BrokerBench.at("a"));
                if (need != null) {
                    refused += bench.test.error(need) instanceof MissingServiceException ? 1 : 0;
                }
            }
            assertThat(refused).isEqualTo(needed ? many : 0);
            bench.broker.register("player", List.of(), BrokerBench.at("a"), bench.provider("last"));
            var required = bench.broker.require(Need.ofService("x", "player"));
            bench.test.crank();
            assertThat(required.isDone()).isFalse();
            a.unanswered.remove().resolve(null);
            bench.test.get(required);
            assertThat(bench.diary).containsExactly("start a", "stop a", "start last");
            assertThat(bench.test.takeProblems()).isEmpty();
        }
    }

    @Test
    void withdraw_ofWhatDoesNotStop_isRejected() {
        try (var bench = new BrokerBench()) {
            var a = bench.offer("player", "a");
            bench.require("player");
            a.stop = a::hang;
            var withdrawn = bench.broker.withdraw(BrokerBench.at("a"));
            bench.seconds(5);
            assertThat(bench.test.error(withdrawn))
                    .hasMessage("node/a has not stopped: node/a did not stop within PT5S");
            a.stop = Promise::done;
        }
    }

    @Test
    void disconnected_receivesNothingAnyMore() {
        try (var bench = new BrokerBench()) {
            bench.offer("player", "a");
            var uses = new int[1];
            var connection = new Broker.Connection() {
                @Override
                public void use(ServiceRecord provider) {
                    uses[0]++;
                }

                @Override
                public void lost(MissingServiceException why) {}
            };
            bench.test.get(bench.broker.connect(Need.ofService("x", "player"), connection));
            bench.test.get(bench.broker.disconnect(connection));
            bench.test.get(replace(bench, "a", bench.provider("b"), "b"));
            assertThat(uses[0]).isEqualTo(1);
        }
    }

    @Test
    void shutDown_stopsInReverseOrderOfStarts_andSaysWhatDidNotStop() {
        var bench = new BrokerBench();
        bench.offer("one", "a");
        var b = bench.offer("two", "b");
        bench.offer("three", "c");
        bench.offer("four", "d");
        bench.require("three");
        bench.require("two");
        bench.require("one");
        b.stop = b::hang;
        var heard = bench.connect("robot 1", "one");
        bench.diary.clear();
        var left = bench.broker.shutDown();
        bench.test.crank();
        assertThat(bench.diary).containsExactly("robot 1 hears of the loss", "stop a", "stop b");
        bench.seconds(5);
        assertThat(bench.test.get(left))
                .extracting(each -> each.provider().name())
                .containsExactly("b");
        assertThat(bench.diary).containsExactly("robot 1 hears of the loss", "stop a", "stop b", "stop c");
        assertThat(heard).containsExactly("use a", "lost");
        var four = Need.ofService("x", "four");
        assertThat(bench.test.error(bench.broker.require(four))).hasMessage("the broker is closed");
        assertThat(bench.test.error(bench.broker.withdraw(BrokerBench.at("d")))).hasMessage("the broker is closed");
        assertThat(bench.test.get(bench.broker.find(four))).as("known").hasSize(1);
        assertThat(bench.test.get(bench.broker.registered())).hasSize(4);
        bench.test.close();
    }

    @Test
    void shutDown_whileSomethingStarts_stopsThatToo() {
        var bench = new BrokerBench();
        var a = bench.offer("one", "a");
        a.start = a::hang;
        var need = bench.broker.require(Need.ofService("x", "one"));
        bench.test.crank();
        bench.broker.close();
        bench.test.crank();
        a.unanswered.remove().resolve(null);
        assertThat(bench.test.get(bench.broker.shutDown())).isEmpty();
        assertThat(bench.diary).containsExactly("start a", "stop a");
        assertThat(bench.missing(need)).isEqualTo("\"x\" needs the service \"one\", and the broker is being closed");
        bench.test.close();
    }

    @Test
    void spaceThatIsClosedBeforeItsBroker_tellsWhatMayGoOn() {
        var bench = new BrokerBench();
        bench.offer("one", "a");
        bench.require("one");
        bench.test.close();
        assertThat(bench.events(BrokerEvent.Abandoned.class))
                .extracting(event -> event.provider().provider().name())
                .containsExactly("a");
    }
}
