package io.troupe.petri.wiring;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.Composition;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.PetriNet;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchEnd;
import io.troupe.petri.wiring.WiringResult.Deadlock;
import java.util.List;
import java.util.Set;
import org.junit.jupiter.api.Test;

/** The paper's four components as declarations give the paper's nets, and its claims. */
class PaperWiringTest {
    private static Deadlock deadlock(Wiring wiring) {
        return (Deadlock) WiringCheck.check(wiring);
    }

    private static PairResult pair(WiringResult result, String one, String other) {
        return result.pairs().stream()
                .filter(pair -> pair.one().equals(one) && pair.other().equals(other))
                .findAny()
                .orElseThrow();
    }

    @Test
    void net_ofTheDeclarations_isTheUncorrectedNetUpToNames() {
        var derived = PaperWiring.wiring().net();

        var names = Isomorphism.find(derived, PaperNets.uncorrected(Reading.A));

        assertThat(names).isPresent();
        assertThat(names.orElseThrow())
                .containsEntry("robot.leaving", "R10")
                .containsEntry("robot waits for player.setValues", "R7''")
                .containsEntry("player takes setValues from robot", "Trp3''")
                .containsEntry("player stops", "Tp4")
                .containsEntry("service.ready", "S10");
    }

    @Test
    void net_withSynchronisedStop_isTheCorrectedNetUpToNames() {
        var derived = PaperWiring.wiring().withSynchronisedStop().net();

        var names = Isomorphism.find(derived, PaperNets.corrected(Reading.A));

        assertThat(names).isPresent();
        assertThat(names.orElseThrow()).containsEntry("all stop", "Tstop");
    }

    /** Shows that the comparison of the two tests above can fail. */
    @Test
    void isomorphism_ofNetsThatDiffer_isNotFound() {
        var paper = PaperNets.uncorrected(Reading.A);
        var oneArcTurned = paper.toBuilder()
                .remove("Tr7")
                .transition("Tr7", List.of("R10"), List.of("R2"))
                .build();
        var symmetricSwap = paper.renamed("other", name -> switch (name) {
            case "S8" -> "S9";
            case "S9" -> "S8";
            default -> name;
        });

        assertThat(Isomorphism.find(paper, oneArcTurned)).isEmpty();
        assertThat(Isomorphism.find(paper, PaperNets.uncorrected(Reading.B))).isEmpty();
        assertThat(Isomorphism.find(paper, symmetricSwap)).isPresent();
    }

    @Test
    void check_ofTheDeclarations_findsSixDeadMarkingsAndTheShortestCounterexample() {
        var result = deadlock(PaperWiring.wiring());

        assertThat(result.figures()).isEqualTo(new Figures(38, 33, 86, 1264, 3706, 6, SearchEnd.COMPLETE, List.of()));
        assertThat(result.counterexamples())
                .extracting(counterexample -> counterexample.firings().size())
                .containsExactly(14, 20, 21, 25, 31, 32);
        var counterexample = result.counterexample();
        assertThat(counterexample.sentence())
                .isEqualTo("player stops; robot waits for player.setValues, which nobody will answer");
        assertThat(counterexample.firings())
                .startsWith("robot: start", "robot asks player.getProxies", "player takes getProxies from robot")
                .contains("player stops", "robot asks player.setValues", "middleware stops", "service: get ready");
        assertThat(counterexample.circle())
                .containsExactly(
                        new Wait.Answer("robot", "player", "setValues"),
                        new Wait.Call("player", "idle", List.of(new Wait.Offer("getProxies", List.of("robot")))));
        assertThat(counterexample.waits())
                .extracting(Wait::component)
                .containsExactly("robot", "player", "middleware", "service");
    }

    @Test
    void counterexamples_firedInTheNet_endInDeadMarkings() {
        var net = PaperWiring.wiring().net();

        for (var counterexample : deadlock(PaperWiring.wiring()).counterexamples()) {
            var end = net.fire(
                    net.initialMarking(),
                    counterexample.firings().stream().map(net::transition).toList());
            assertThat(net.enabled(end)).isEmpty();
        }
    }

    @Test
    void causes_areTheNearestBlocksForEver() {
        var causes = deadlock(PaperWiring.wiring()).causes();

        assertThat(causes)
                .extracting(counterexample -> counterexample.firings().size())
                .containsExactly(6, 8);
        assertThat(causes)
                .extracting(Counterexample::sentence)
                .containsExactly(
                        "middleware stops; service (ready) waits to be called: receive by middleware, which nobody will"
                                + " do",
                        "player stops; robot waits for player.setValues, which nobody will answer");
    }

    @Test
    void pairs_showTheirCauses() {
        var result = deadlock(PaperWiring.wiring());

        assertThat(result.pairs()).hasSize(3);
        var robotAndPlayer = pair(result, "robot", "player");
        assertThat(robotAndPlayer.figures())
                .isEqualTo(new Figures(17, 15, 38, 28, 43, 1, SearchEnd.COMPLETE, List.of()));
        assertThat(robotAndPlayer.counterexamples()).hasSize(1);
        assertThat(robotAndPlayer.counterexamples().get(0).firings())
                .hasSize(8)
                .endsWith("player stops", "robot asks player.setValues");
        var playerAndMiddleware = pair(result, "player", "middleware");
        assertThat(playerAndMiddleware.figures())
                .isEqualTo(new Figures(10, 10, 24, 14, 27, 0, SearchEnd.COMPLETE, List.of()));
        assertThat(playerAndMiddleware.isFree()).isTrue();
        var middlewareAndService = pair(result, "middleware", "service");
        assertThat(middlewareAndService.figures())
                .isEqualTo(new Figures(17, 16, 40, 32, 55, 2, SearchEnd.COMPLETE, List.of()));
        assertThat(middlewareAndService.counterexamples())
                .extracting(Counterexample::sentence)
                .containsExactly(
                        "middleware stops; service (ready) waits to be called: receive by middleware, which nobody will"
                                + " do",
                        "middleware waits for service.receive; service waits for middleware.register: all ask and"
                                + " nobody answers");
    }

    @Test
    void pairNet_ofRobotAndPlayer_isThePapersUpToNames() {
        var derived = new WiringNet(PaperWiring.wiring(), Set.of("robot", "player")).net();
        PetriNet paper = Composition.compose(
                "pair",
                List.of(PaperNets.robot(), PaperNets.player()),
                List.of(PaperNets.getProxies(), PaperNets.setValues()));

        assertThat(Isomorphism.find(derived, paper)).isPresent();
    }

    @Test
    void repair_stopsWhereEachWaitsForItsNextCall_andIsProved() {
        var repair = deadlock(PaperWiring.wiring()).repair().orElseThrow();

        assertThat(repair.isProved()).isTrue();
        assertThat(repair.stops())
                .hasSize(4)
                .containsEntry("robot", List.of("leaving"))
                .containsEntry("player", List.of("ready"))
                .containsEntry("middleware", List.of("ready"))
                .containsEntry("service", List.of("ready"));
        assertThat(repair.result().figures())
                .isEqualTo(new Figures(38, 30, 86, 429, 1084, 0, SearchEnd.COMPLETE, List.of()));
        assertThat(repair.toString()).contains("proved free of deadlock", "429 markings");
    }

    @Test
    void twoRobots_withAPlayerSessionEach_haveTheKnownNumbers() {
        var result = deadlock(PaperWiring.robots(2));

        assertThat(result.figures().markings()).isEqualTo(49_536);
        assertThat(result.figures().deadMarkings()).isEqualTo(18);
        var repair = result.repair().orElseThrow();
        assertThat(repair.isProved()).isTrue();
        assertThat(repair.result().figures().markings()).isEqualTo(11_653);
    }

    @Test
    void deadlock_inAPartOfTheGraph_isReportedWithoutCauses() {
        var complete = ReachabilityGraph.explore(PaperWiring.wiring().net());
        var result = (Deadlock)
                WiringCheck.check(PaperWiring.wiring(), complete.dead().get(0).index() + 1);

        assertThat(result.figures().isComplete()).isFalse();
        assertThat(result.reduced().isComplete()).isTrue();
        assertThat(result.counterexample().firings()).hasSize(14);
        assertThat(result.causes()).isEmpty();
    }
}
