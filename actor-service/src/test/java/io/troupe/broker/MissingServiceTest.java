package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.bus.Address;
import java.util.List;
import org.junit.jupiter.api.Test;

/** The error for a need without a provider lists what is registered, on one line. */
class MissingServiceTest {
    @Test
    void serviceThatNobodyOffers_isNamed_withWhatIsThere_andWhatIsSimilar() {
        try (var bench = new BrokerBench()) {
            bench.offer("player", "p", "senses", "drives");
            bench.offer("spaceWanderer", "w");
            bench.require("player");
            assertThat(bench.missing(bench.broker.require(Need.ofService("robot 2", "spaceWandrer"))))
                    .isEqualTo(
                            "\"robot 2\" needs the service \"spaceWandrer\", which nobody offers; did you mean \"spaceWanderer\"? "
                                    + "registered: player (senses, drives; well), spaceWanderer (not started)");
        }
    }

    @Test
    void capabilityThatNobodyHas_isNamed() {
        try (var bench = new BrokerBench()) {
            bench.offer("player", "p", "senses", "drives");
            assertThat(bench.missing(bench.broker.require(Need.ofCapability("robot 2", "drive"))))
                    .isEqualTo(
                            "\"robot 2\" needs the capability \"drive\", which nobody offers; did you mean \"drives\"? "
                                    + "registered: player (senses, drives; not started)");
            assertThat(bench.missing(bench.broker.require(new Need("robot 2", "player", "flies"))))
                    .isEqualTo(
                            "\"robot 2\" needs the service \"player\" with the capability \"flies\", which nobody offers; "
                                    + "registered: player (senses, drives; not started)");
        }
    }

    @Test
    void nothingRegistered_isSaid_andLineBreaksAreNot() {
        try (var bench = new BrokerBench()) {
            var need = bench.broker.require(Need.ofService("robot\n2", "map"));
            assertThat(bench.missing(need))
                    .isEqualTo("\"robot 2\" needs the service \"map\", which nobody offers; registered: nothing");
            assertThat(((MissingServiceException) bench.test.error(need)).need().service())
                    .isEqualTo("map");
        }
    }

    @Test
    void connect_toWhatNobodyOffers_isRejected_andConnectsWhenSomebodyDoes() {
        try (var bench = new BrokerBench()) {
            var heard = bench.connect("robot 1", "player");
            assertThat(heard).isEmpty();
            bench.offer("player", "p");
            bench.test.crank();
            assertThat(heard).containsExactly("use p");
        }
    }

    @Test
    void find_isByNameAndByCapability_theBestFirst_andStartsNothing() {
        try (var bench = new BrokerBench()) {
            var a = bench.offer("camera", "a", "senses");
            bench.offer("player", "b", "senses", "drives");
            bench.offer("player", "c", "drives");
            assertThat(names(bench, Need.ofService("x", "player"))).containsExactly("b", "c");
            assertThat(names(bench, Need.ofCapability("x", "senses"))).containsExactly("a", "b");
            assertThat(names(bench, new Need("x", "player", "senses"))).containsExactly("b");
            assertThat(bench.diary).isEmpty();

            bench.require("player");
            assertThat(names(bench, Need.ofCapability("x", "senses"))).containsExactly("b", "a");
            bench.require("camera");
            assertThat(names(bench, Need.ofCapability("x", "senses"))).containsExactly("a", "b");
            a.check = a::hang;
            bench.seconds(2);
            assertThat(bench.health("a")).isEqualTo(Health.SUSPECT);
            assertThat(names(bench, Need.ofCapability("x", "senses"))).containsExactly("b", "a");
        }
    }

    @Test
    void messageAboutManyProviders_namesSome_andSaysHowManyMoreThereAre() {
        try (var bench = new BrokerBench()) {
            for (int i = 0; i < 2_000; i++) {
                var one = bench.provider("p" + i);
                one.start = one::fail;
                bench.broker.register("player", List.of("drives"), BrokerBench.at("p" + i), one);
            }
            var none = bench.broker.require(Need.ofService("x", "camera"));
            assertThat(bench.missing(none))
                    .startsWith("\"x\" needs the service \"camera\", which nobody offers; registered: player (drives; ")
                    .endsWith(" and 1980 more")
                    .hasSizeLessThan(1_000);
            var broken = bench.broker.require(Need.ofService("x", "player"));
            assertThat(bench.missing(broken))
                    .contains("node/p19 (java.lang.IllegalStateException: p19 is broken) and 1980 more; registered: ")
                    .doesNotContain("node/p20 ")
                    .hasSizeLessThan(4_000);
            assertThat(bench.test.error(broken).getSuppressed()).hasSize(20);
            assertThat(bench.test.error(bench.broker.withdraw(BrokerBench.at("q"))))
                    .hasMessageEndingWith("node/p19 and 1980 more");
        }
    }

    private static List<String> names(BrokerBench bench, Need need) {
        return bench.test.get(bench.broker.find(need)).stream()
                .map(each -> each.provider().name())
                .toList();
    }

    @Test
    void addressThatIsTaken_isRefused() {
        try (var bench = new BrokerBench()) {
            bench.offer("player", "p");
            var again = bench.broker.register("camera", List.of(), new Address("node", "p"), bench.provider("p"));
            assertThat(bench.test.error(again))
                    .isInstanceOf(IllegalArgumentException.class)
                    .hasMessage("the address node/p is taken by the service \"player\", expected a free one");
            assertThat(bench.test.error(bench.broker.withdraw(new Address("node", "q"))))
                    .hasMessage("nothing is registered at node/q; registered: node/p");
        }
    }
}
