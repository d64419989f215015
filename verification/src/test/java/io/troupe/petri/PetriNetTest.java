package io.troupe.petri;

import static io.troupe.petri.Nets.net;
import static io.troupe.petri.Nets.refusals;
import static io.troupe.petri.Nets.refused;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.petri.PaperNets.Reading;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Random;
import org.junit.jupiter.api.Test;

/** Nets, their builder and their composition. */
class PetriNetTest {
    /** Two parts and a wheel make a cart; carts are sold one by one. */
    private static PetriNet workshop() {
        return PetriNet.builder("workshop")
                .place("parts", 5)
                .place("wheels", 2)
                .place("carts")
                .transition("make", List.of("wheels"), List.of("carts"))
                .arc("parts", "make", 2)
                .transition("sell", List.of("carts"), List.of())
                .build();
    }

    @Test
    void net_built_keepsOrderTokensAndWeights() {
        var net = workshop();
        assertThat(net).hasToString("workshop (3 places, 2 transitions, 4 arcs)");
        assertThat(net.places()).extracting(Place::name).containsExactly("parts", "wheels", "carts");
        assertThat(net.transition("make").inputs())
                .containsExactly(new Arc(net.place("wheels"), 1), new Arc(net.place("parts"), 2));
        assertThat(net.initialMarking()).hasToString("{5*parts, 2*wheels}");
    }

    @Test
    void fire_enabled_movesTokensByWeight() {
        var net = workshop();
        var after = net.fire(net.initialMarking(), net.transition("make"));
        assertThat(after).isEqualTo(net.marking("parts", "parts", "parts", "wheels", "carts"));
        assertThat(net.enabled(after)).containsExactly(net.transition("make"), net.transition("sell"));
        assertThat(net.initialMarking().tokens(net.place("parts"))).isEqualTo(5);
    }

    @Test
    void fire_notEnabledOrOutranked_tellsWhy() {
        var net = workshop();
        var make = net.transition("make");
        var ranked = net.toBuilder().priority("sell", 3).build();
        var marking = ranked.marking("parts", "parts", "wheels", "carts");
        assertThatThrownBy(() -> net.fire(net.marking("parts"), make))
                .isInstanceOf(IllegalStateException.class)
                .hasMessage("transition make may not fire in {parts}: wheels holds 0 of 1, parts holds 1 of 2");
        assertThat(ranked.enabled(marking)).containsExactly(ranked.transition("sell"));
        assertThatThrownBy(() -> ranked.fire(marking, ranked.transition("make")))
                .hasMessageEndingWith("sell has priority 3 over 0");
        assertThat(ranked.enabled(ranked.initialMarking())).containsExactly(ranked.transition("make"));
    }

    @Test
    void fire_placeOverflowing_isRefused() {
        var net = net("flood", "lake=" + Long.MAX_VALUE, "rain: > lake");
        assertThatThrownBy(() -> net.fire(net.initialMarking(), net.transition("rain")))
                .isInstanceOf(ArithmeticException.class)
                .hasMessage("place lake would hold more than 9223372036854775807 tokens");
        assertThatThrownBy(() -> ReachabilityGraph.explore(net))
                .hasMessageContaining("place lake would hold more than ");
    }

    @Test
    void builder_badInput_namesNetThingAndValue() {
        var net = workshop().toBuilder();

        assertThat(refusals(
                        () -> net.place("make"),
                        () -> net.transition("parts"),
                        () -> net.place("nails", -1),
                        () -> net.arc("wheels", "sell", 0),
                        () -> net.arc("wheels", "burn"),
                        () -> net.arc("wheels", "parts"),
                        () -> net.arc("parts", "make"),
                        () -> net.transition("burn", List.of("wood"), List.of()),
                        () -> net.transition("burn", List.of("carts", "carts"), List.of()),
                        () -> net.remove("burn"),
                        () -> net.place(" ")))
                .isEqualTo("""
                net workshop: make is already the name of a transition
                net workshop: parts is already the name of a place
                net workshop: place nails has -1 tokens, expected 0 or more
                net workshop: arc wheels -> sell has weight 0, expected 1 or more
                net workshop: arc wheels -> burn: there is no place or transition called burn
                net workshop: arc wheels -> parts joins two places, expected a place and a transition
                net workshop: arc parts -> make is there already; give it a weight instead
                net workshop: transition burn: there is no place called wood
                net workshop: transition burn names place carts twice on one side; use an arc with a weight
                net workshop: there is no transition called burn
                net workshop: a name is " ", expected text without control characters or space around it""");
        assertThat(net.build().sameStructureAs(workshop())).isTrue();
    }

    @Test
    void lookup_unknownOrForeign_isRefused() {
        var net = workshop();
        var other = net("other", "x", "go: x >");
        var initial = net.initialMarking();
        refused(() -> net.place("make"), "net workshop has no place called make");
        refused(() -> net.fire(initial, other.transition("go")), "transition go is not of net workshop");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> net.enabled(other.initialMarking()))
                .withMessageContaining("is of a net with other places than workshop");
        assertThatIllegalArgumentException().isThrownBy(() -> initial.tokens(other.place("x")));
    }

    @Test
    void sameStructure_seesEveryDifferenceButOrderAndName() {
        var net = workshop();
        var reordered = net("elsewhere", "carts wheels=2 parts=5", "sell: carts >", "make: wheels 2*parts > carts");
        var ranked = reordered.toBuilder().priority("sell", 1).build();
        var withArc = net.toBuilder().arc("make", "wheels").build();
        var withPlace = net.toBuilder().place("nails").build();
        assertThat(reordered.sameStructureAs(net)).isTrue();
        var withWheel = net("elsewhere", "carts wheels=3 parts=5", "sell: carts >", "make: wheels 2*parts > carts");
        var withPart = net("elsewhere", "carts wheels=2 parts=5", "sell: carts >", "make: wheels 3*parts > carts");
        assertThat(List.of(ranked, withArc, withPlace, withWheel, withPart, net.renamed("x", name -> name + "1")))
                .noneMatch(different -> different.sameStructureAs(net));
    }

    @Test
    void marking_covers_comparesEveryPlace() {
        var net = workshop();
        assertThat(net.marking("parts", "parts", "carts").covers(net.marking("parts", "carts")))
                .isTrue();
        assertThat(net.marking("parts", "parts").covers(net.marking("carts"))).isFalse();
        assertThat(net.marking("parts", "carts").marked()).hasToString("[parts, carts]");
    }

    private static PetriNet client(String name) {
        var client = net("client", "idle=1 done", "ask: idle > done", "again: done > idle");
        return client.renamed(name, part -> name + "." + part);
    }

    private static final PetriNet SERVER = net("server", "free=1 busy", "serve: free > busy", "rest: busy > free");

    @Test
    void meld_oneCall_makesFourPlacesAndThreeTransitions() {
        var net = Composition.compose("call", List.of(client("c"), SERVER), List.of(Meld.of("c.ask", "serve")));
        var expected = net(
                "expected",
                "c.idle=1 c.done free=1 busy c.ask.waiting c.ask.pending serve.before serve.after",
                "c.again: c.done > c.idle",
                "rest: busy > free",
                "c.ask'': c.idle > c.ask.waiting",
                "c.ask/serve.accept: c.ask.waiting free > c.ask.pending serve.before",
                "serve: serve.before > serve.after",
                "c.ask/serve.answer: c.ask.pending serve.after > c.done busy");
        assertThat(net.structure()).isEqualTo(expected.structure());
    }

    @Test
    void meld_severalPlacesAndWeights_areTakenAndPutAsAWhole() {
        var requestor = net("r", "a=2 key=1 b", "ask: key 2*a > key 3*b");
        var provider = net("p", "c=4 d", "do: 4*c > d");
        var ranked = List.of(
                requestor.toBuilder().priority("ask", -1).build(),
                provider.toBuilder().priority("do", 2).build());
        var net = Composition.compose("both", ranked, List.of(Meld.of("ask", "do")));
        assertThat(ReachabilityGraph.explore(net).dead()).singleElement().satisfies(state -> {
            assertThat(state).hasToString("{key, 3*b, d}");
            assertThat(state.shortestTrace()).hasToString("[ask'', ask/do.accept, do, ask/do.answer]");
        });
        assertThat(net.transitions()).extracting(Transition::priority).containsExactly(2, -1, 2, 2);
    }

    @Test
    void meld_twoRequestsToOneOffer_areServedInTurn() {
        var net = Composition.compose(
                "shared",
                List.of(client("c"), client("d"), SERVER),
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
        var components =
                List.of(PaperNets.robot(), PaperNets.player(), PaperNets.middleware(), PaperNets.service(Reading.A));
        var expected = PaperNets.uncorrected(Reading.A).structure();
        var melds = new ArrayList<>(PaperNets.melds());
        for (var seed = 1L; seed <= 20; seed++) {
            Collections.shuffle(melds, new Random(seed));
            var shuffled = Composition.compose("shuffled", components, melds);
            assertThat(shuffled.structure()).as("seed %d", seed).isEqualTo(expected);
        }
    }

    @Test
    void fuse_addsUpAllSteps() {
        var two = Composition.compose("two", List.of(client("c"), client("d")), List.of());
        var net = Composition.fuse(two, "both", List.of("c.ask", "d.ask"));
        var both = net.transition("both");
        assertThat(both.inputs()).extracting(Arc::place).containsExactly(net.place("c.idle"), net.place("d.idle"));
        assertThat(both.outputs()).extracting(Arc::place).containsExactly(net.place("c.done"), net.place("d.done"));
        assertThat(net.transitions()).hasSize(3);
    }

    @Test
    void composition_badInput_isRefused() {
        refused(() -> Meld.of("c.ask", "c.ask"), "transition c.ask cannot be melded with itself");
        refusedMelds("net x: there is no transition called sreve", Meld.of("c.ask", "sreve"));
        refusedMelds("net x: request c.ask is melded twice", Meld.of("c.ask", "serve"), Meld.of("c.ask", "rest"));
        refused(
                () -> Composition.compose("x", List.of(SERVER, SERVER), List.of()),
                "net x: free is already the name of a place");
        refusedMelds(
                "net x: requests c.ask and c.again share offer serve and must name the same places before and after it",
                Meld.of("c.ask", "serve"),
                new Meld("c.again", "serve", "q", "w", "s", "p", "elsewhere", "serve.after", "t"));
        for (var none : List.of(List.<String>of(), List.of("rest", "rest"))) {
            assertThatIllegalArgumentException().isThrownBy(() -> Composition.fuse(SERVER, "stop", none));
        }
    }

    private static void refusedMelds(String message, Meld... melds) {
        refused(() -> Composition.compose("x", List.of(client("c"), SERVER), List.of(melds)), message);
    }

    /** The ready transitions after each firing, and after each that is taken back, are those of the marking. */
    @Test
    void tokenGame_knowsWhatMayFire_alsoAfterFiringsTakenBack() {
        var net = net("call", "idle=1 waits", "ask: idle > waits", "answer: waits > idle");
        var game = new TokenGame(net);
        game.fire(net.transition("ask").index());
        game.takeBack(net.transition("ask").index());
        assertThat(game.tokens()).containsExactly(1, 0);
        assertThat(game.mayFire(net.transition("answer").index())).isFalse();
        game.fire(net.transition("ask").index());
        assertThat(game.mayFire(net.transition("answer").index())).isTrue();
        for (var seed = 1L; seed <= 100; seed++) {
            var random = new Random(seed);
            playAtRandom(seed, Nets.inhibited(Nets.any(random), random), random);
        }
    }

    private static void playAtRandom(long seed, PetriNet net, Random random) {
        var game = new TokenGame(net);
        var markings = new ArrayList<>(List.of(net.initialMarking()));
        var fired = new ArrayList<Integer>();
        for (var i = 0; i < 30; i++) {
            var marking = markings.getLast();
            var enabled = net.enabled(marking);
            assertThat(net.transitions().stream()
                            .filter(t -> game.mayFire(t.index()))
                            .toList())
                    .as("seed %d", seed)
                    .isEqualTo(enabled);
            assertThat(game.tokens()).as("seed %d", seed).isEqualTo(marking.toArray());
            if (!enabled.isEmpty() && (fired.isEmpty() || random.nextInt(3) > 0)) {
                var t = enabled.get(random.nextInt(enabled.size()));
                game.fire(t.index());
                fired.add(t.index());
                markings.add(net.fire(marking, t));
            } else if (!fired.isEmpty()) {
                game.takeBack(fired.removeLast());
                markings.removeLast();
            }
        }
    }
}
