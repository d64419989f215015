package io.troupe.petri;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Random;
import org.junit.jupiter.api.Test;

class CompositionTest {
    private static PetriNet client(String name) {
        return PetriNet.builder(name)
                .place(name + ".idle", 1)
                .place(name + ".done")
                .transition(name + ".ask", List.of(name + ".idle"), List.of(name + ".done"))
                .transition(name + ".again", List.of(name + ".done"), List.of(name + ".idle"))
                .build();
    }

    private static PetriNet server() {
        return PetriNet.builder("server")
                .place("free", 1)
                .place("busy")
                .transition("serve", List.of("free"), List.of("busy"))
                .transition("rest", List.of("busy"), List.of("free"))
                .build();
    }

    @Test
    void meld_oneCall_makesFourPlacesAndThreeTransitions() {
        var net = Composition.compose("call", List.of(client("c"), server()), List.of(Meld.of("c.ask", "serve")));

        var expected = PetriNet.builder("expected")
                .place("c.idle", 1)
                .place("c.done")
                .place("free", 1)
                .place("busy")
                .place("c.ask.waiting")
                .place("c.ask.pending")
                .place("serve.before")
                .place("serve.after")
                .transition("c.again", List.of("c.done"), List.of("c.idle"))
                .transition("rest", List.of("busy"), List.of("free"))
                .transition("c.ask''", List.of("c.idle"), List.of("c.ask.waiting"))
                .transition(
                        "c.ask/serve.accept",
                        List.of("c.ask.waiting", "free"),
                        List.of("c.ask.pending", "serve.before"))
                .transition("serve", List.of("serve.before"), List.of("serve.after"))
                .transition("c.ask/serve.answer", List.of("c.ask.pending", "serve.after"), List.of("c.done", "busy"))
                .build();
        assertThat(net.structure()).isEqualTo(expected.structure());
    }

    @Test
    void meld_severalPlacesAndWeights_areTakenAndPutAsAWhole() {
        var requestor = PetriNet.builder("r")
                .place("a", 2)
                .place("key", 1)
                .place("b")
                .transition("ask", List.of("key"), List.of("key"))
                .arc("a", "ask", 2)
                .arc("ask", "b", 3)
                .priority("ask", -1)
                .build();
        var provider = PetriNet.builder("p")
                .place("c", 4)
                .place("d")
                .transition("do", List.of(), List.of("d"))
                .arc("c", "do", 4)
                .priority("do", 2)
                .build();

        var net = Composition.compose("both", List.of(requestor, provider), List.of(Meld.of("ask", "do")));
        var end = ReachabilityGraph.explore(net).dead();

        assertThat(end).singleElement().satisfies(state -> {
            assertThat(state).hasToString("{key, 3*b, d}");
            assertThat(state.shortestTrace())
                    .extracting(Transition::name)
                    .containsExactly("ask''", "ask/do.accept", "do", "ask/do.answer");
        });
        assertThat(net.transitions()).extracting(Transition::priority).containsExactly(2, -1, 2, 2);
    }

    @Test
    void meld_twoRequestsToOneOffer_areServedInTurn() {
        var net = Composition.compose(
                "shared",
                List.of(client("c"), client("d"), server()),
                List.of(Meld.of("c.ask", "serve"), Meld.of("d.ask", "serve")));

        var graph = ReachabilityGraph.explore(net);

        assertThat(net.places()).hasSize(6 + 2 + 4);
        assertThat(graph.deadlockFree()).isEqualTo(Verdict.YES);
        assertThat(graph.mostTokens()).isEqualTo(1);
        assertThat(graph.neverFired()).isEmpty();
        assertThat(graph.states())
                .noneMatch(state -> state.marking().covers(net.marking("c.ask.pending", "d.ask.pending")));
    }

    @Test
    void meld_inAnyOrder_makesTheSameNet() {
        var components = List.of(
                PaperNets.robot(), PaperNets.player(), PaperNets.middleware(), PaperNets.service(PaperNets.Reading.A));
        var expected = PaperNets.uncorrected(PaperNets.Reading.A).structure();
        var melds = new ArrayList<>(PaperNets.melds());

        for (var seed = 1L; seed <= 20; seed++) {
            Collections.shuffle(melds, new Random(seed));
            assertThat(Composition.compose("shuffled", components, melds).structure())
                    .as("seed %d", seed)
                    .isEqualTo(expected);
        }
    }

    @Test
    void fuse_addsUpAllSteps() {
        var net = Composition.fuse(
                Composition.compose("two", List.of(client("c"), client("d")), List.of()),
                "both",
                List.of("c.ask", "d.ask"));

        assertThat(net.transition("both").inputs())
                .extracting(Arc::place)
                .containsExactly(net.place("c.idle"), net.place("d.idle"));
        assertThat(net.transition("both").outputs())
                .extracting(Arc::place)
                .containsExactly(net.place("c.done"), net.place("d.done"));
        assertThat(net.transitions()).hasSize(3);
    }

    @Test
    void composition_badInput_isRefused() {
        var parts = List.of(client("c"), server());

        assertThatIllegalArgumentException()
                .isThrownBy(() -> Composition.compose("x", parts, List.of(Meld.of("c.ask", "c.ask"))))
                .withMessage("transition c.ask cannot be melded with itself");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> Composition.compose("x", parts, List.of(Meld.of("c.ask", "sreve"))))
                .withMessage("net x: there is no transition called sreve");
        assertThatIllegalArgumentException()
                .isThrownBy(() ->
                        Composition.compose("x", parts, List.of(Meld.of("c.ask", "serve"), Meld.of("c.ask", "rest"))))
                .withMessage("net x: request c.ask is melded twice");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> Composition.compose("x", List.of(server(), server()), List.of()))
                .withMessage("net x: free is already the name of a place");
        var other = new Meld("c.again", "serve", "q", "w", "s", "p", "elsewhere", "serve.after", "t");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> Composition.compose("x", parts, List.of(Meld.of("c.ask", "serve"), other)))
                .withMessage(
                        "net x: requests c.ask and c.again share offer serve and must name the same places before and"
                                + " after it");
        assertThatIllegalArgumentException().isThrownBy(() -> Composition.fuse(server(), "stop", List.of()));
        assertThatIllegalArgumentException()
                .isThrownBy(() -> Composition.fuse(server(), "stop", List.of("rest", "rest")));
    }
}
