package io.troupe.petri.bip;

import static io.troupe.petri.Nets.refusals;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchEnd;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.Transition;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.Set;
import java.util.TreeSet;
import java.util.stream.Collectors;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** The rules of BIP on small models with known states, and the translation to nets on random ones. */
class BipModelTest {
    private static final AtomType LAMP =
            AtomType.starting("Lamp", "off").on("press", "off", "lit").on("press", "lit", "off");
    private static final AtomType ONCE = AtomType.starting("Once", "fresh").on("go", "fresh", "spent");

    private static BipModel.Builder three() {
        return BipModel.named("three").component("a", ONCE).component("b", ONCE).component("c", ONCE);
    }

    private static List<String> firings(BipStates.State state) {
        return state.successors().stream()
                .map(each -> each.interaction().toString())
                .toList();
    }

    private static BipStates.State initial(BipModel model) {
        return BipStates.explore(model).states().getFirst();
    }

    // ---- the sample of the Javadoc

    @Test
    void lamps_thatAreSwitchedTogether_haveTwoStates() {
        var lamp = AtomType.starting("Lamp", "off").on("press", "off", "lit").on("press", "lit", "off");
        var model = BipModel.named("two_lamps")
                .component("left", lamp)
                .component("right", lamp)
                .connector("both", "left.press", "right.press")
                .build();
        assertThat(BipStates.explore(model).size()).isEqualTo(2);
    }

    @Test
    void connectors_areWrittenAsInTheLanguage() {
        var together = Connector.of("together", "left.go", "right.go");
        var broadcast = Connector.of("broadcast", "sender.send'", "first.receive", "second.receive");

        assertThat(together.isRendezvous()).isTrue();
        assertThat(broadcast).hasToString("broadcast(sender.send', first.receive, second.receive)");
    }

    // ---- interactions

    @Test
    void rendezvous_needsAllItsPorts() {
        var model = three().connector("alone", "a.go")
                .connector("pair", "b.go", "a.go")
                .build();
        var states = BipStates.explore(model);

        assertThat(states.size()).isEqualTo(3);
        assertThat(states.edgeCount()).isEqualTo(2);
        assertThat(states.dead())
                .extracting(BipStates.State::toString)
                .containsExactly("a.spent b.fresh c.fresh", "a.spent b.spent c.fresh");
        assertThat(model.unconnectedPorts()).containsExactly("c.go");
    }

    @Test
    void trigger_takesAlongAsManyAsCan() {
        var model = three().connector("cast", "a.go'", "b.go", "c.go")
                .connector("early", "b.go")
                .build();
        var states = BipStates.explore(model);

        assertThat(firings(states.states().getFirst())).containsExactly("cast", "early");
        var late = states.find(state -> state.isIn("b", "spent") && state.isIn("a", "fresh"));
        assertThat(firings(late.orElseThrow())).containsExactly("cast[a.go c.go]");
        assertThat(states.size()).isEqualTo(3);
    }

    @Test
    void synchron_neverGoesWithoutATrigger() {
        var model = three().connector("cast", "a.go'", "b.go")
                .connector("a_first", "a.go")
                .build();
        var states = BipStates.explore(model);

        assertThat(states.count(state -> state.isIn("b", "spent") && state.isIn("a", "fresh")))
                .isZero();
    }

    @Test
    void twoTriggers_makeEachSubsetPossible_andTheLargestGoes() {
        var model = three().connector("any", "a.go'", "b.go'", "c.go").build();

        assertThat(model.interactions())
                .extracting(Interaction::toString)
                .containsExactly("any[a.go]", "any[b.go]", "any[a.go b.go]", "any[a.go c.go]", "any[b.go c.go]", "any");
        assertThat(firings(initial(model))).containsExactly("any");
    }

    // ---- priorities

    @Test
    void priority_holdsOnlyWhileTheOtherCan_andIsTransitive() {
        var model = three().connector("low", "a.go")
                .connector("middle", "b.go")
                .connector("high", "c.go")
                .priority("low", "middle")
                .priority("middle", "high")
                .build();
        var states = BipStates.explore(model);

        assertThat(model.allPriorities())
                .extracting(BipModel.Priority::toString)
                .containsExactly("low < middle", "low < high", "middle < high");
        assertThat(states.size()).isEqualTo(4);
        assertThat(states.dead().getFirst().trace())
                .extracting(Interaction::toString)
                .containsExactly("high", "middle", "low");
    }

    /** With c spent beforehand nothing but the closure of both priorities would hold the lowest back. */
    @Test
    void priority_holdsBackAcrossOneThatCannotHappen() {
        var never = AtomType.starting("Never", "here").on("go", "there", "here").on("move", "here", "there");
        var model = BipModel.named("gap")
                .component("a", ONCE)
                .component("b", never)
                .component("c", ONCE)
                .connector("low", "a.go")
                .connector("middle", "b.go")
                .connector("high", "c.go")
                .priority("low", "middle")
                .priority("middle", "high")
                .build();

        assertThat(firings(initial(model))).containsExactly("high");
    }

    @Test
    void priority_doesNotHoldBackWhatItDoesNotCompare() {
        var model = three().connector("low", "a.go")
                .connector("high", "b.go")
                .connector("other", "c.go")
                .priority("low", "high")
                .build();

        assertThat(firings(initial(model))).containsExactly("high", "other");
        assertThat(BipStates.explore(model).size()).isEqualTo(6);
    }

    // ---- the states

    @Test
    void neverAgain_areTheStatesThatLeadNowhere() {
        var model = three().connector("spend", "a.go")
                .connector("both", "a.go", "b.go")
                .build();
        var states = BipStates.explore(model);

        assertThat(states.neverAgain(state -> state.isIn("b", "spent")))
                .extracting(BipStates.State::toString)
                .containsExactly("a.spent b.fresh c.fresh");
        assertThat(states.neverFired()).isEmpty();
    }

    @Test
    void limits_endTheSearch_andTheResultSaysSo() {
        var model = three().connector("a_", "a.go")
                .connector("b_", "b.go")
                .connector("c_", "c.go")
                .build();
        var some = BipStates.explore(model, SearchLimits.markings(5));

        assertThat(some.end()).isEqualTo(SearchEnd.LIMIT);
        assertThat(some.size()).isBetween(1, 5);
        assertThat(some.summary()).contains("stopped at the limit", "dead states so far: 0");
        assertThat(BipStates.explore(model, SearchLimits.markings(8)).isComplete())
                .isTrue();
        assertThat(BipStates.explore(model, SearchLimits.markings(8).cancelledBy(() -> true))
                        .end())
                .isEqualTo(SearchEnd.CANCELLED);
        assertThat(BipStates.explore(model, SearchLimits.markings(8).within(1)).end())
                .isEqualTo(SearchEnd.MEMORY);
    }

    // ---- bad models

    @Test
    void badModels_areRefusedWithOneClearLine() {
        assertThat(refusals(
                        () -> three().connector("x", "a.gone"),
                        () -> three().connector("x", "d.go"),
                        () -> three().connector("x", "a"),
                        () -> three().connector("x"),
                        () -> three().connector("x", "a.go", "a.go"),
                        () -> three().component("a", LAMP),
                        () -> three().connector("a", "a.go"),
                        () -> three().component("end", LAMP),
                        () -> three().component("two words", LAMP),
                        () -> three().priority("x", "y"),
                        () -> three().connector("x", "a.go")
                                .connector("y", "b.go")
                                .priority("x", "y")
                                .priority("y", "x")
                                .build(),
                        () -> three().component("d", AtomType.starting("Once", "fresh")),
                        () -> three().component(
                                        "d", AtomType.starting("Gap", "here").on("go", "there", "here")),
                        () -> AtomType.starting("Twice", "here")
                                .on("go", "here", "there")
                                .on("go", "here", "here"),
                        () -> AtomType.starting("Same", "go").on("go", "go", "there")))
                .isEqualTo("""
                        x(a.gone) ends at a.gone, but Once has no port gone; expected one of go
                        x(d.go) ends at d.go, but there is no component d; did you mean "a"? expected one of a, b, c
                        connector x has the end "a", expected COMPONENT.PORT, or COMPONENT.PORT' for a trigger
                        connector x has no ends, expected one or more
                        connector x has two ends at component a, expected one: a component takes one step at a time
                        a is already the name of a component or connector of three
                        a is already the name of a component or connector of three
                        the component is called "end", expected a name that is no word of the BIP language
                        the component is called "two words", expected letters, digits and underscores, and no digit first
                        the priority x < y is about x, which is no connector; there is none
                        in three connector x goes before itself by the priorities [x < y, y < x], expected no circle
                        there are two different atom types called Once, expected one
                        atom type Gap has places that no steps reach: there
                        Twice has two steps on go from here, expected one; for a choice use two ports
                        Same has a port and a place called go, expected different names""");
    }

    // ---- the translation

    /** Markings without the places for ports that are not enabled, which follow from the others. */
    private static Set<String> places(ReachabilityGraph.State state) {
        return state.marking().marked().stream()
                .map(Object::toString)
                .filter(place -> !place.startsWith("no "))
                .collect(Collectors.toCollection(TreeSet::new));
    }

    private static Set<String> places(BipStates.State state) {
        return new TreeSet<>(List.of(state.toString().split(" ")));
    }

    private static void assertSame(BipModel model) {
        var states = BipStates.explore(model);
        var net = BipNet.of(model);
        var graph = ReachabilityGraph.explore(net.net());

        var direct = new ArrayList<String>();
        states.states()
                .forEach(state -> state.successors()
                        .forEach(edge ->
                                direct.add(places(state) + " " + edge.interaction() + " " + places(edge.target()))));
        var translated = new ArrayList<String>();
        graph.states()
                .forEach(state -> state.successors()
                        .forEach(edge -> translated.add(places(state) + " " + net.interaction(edge.transition()) + " "
                                + places(edge.target()))));
        assertThat(graph.size()).isEqualTo(states.size());
        assertThat(graph.mostTokens()).isEqualTo(1);
        assertThat(translated).containsExactlyInAnyOrderElementsOf(direct);
        assertThat(states.edgeCount()).isEqualTo(direct.size());
        assertThat(DeadlockSearch.run(net.net()).deadlocks().stream()
                        .map(dead -> dead.marking().marked().stream()
                                .map(Object::toString)
                                .filter(place -> !place.startsWith("no "))
                                .collect(Collectors.toCollection(TreeSet::new))))
                .containsExactlyInAnyOrderElementsOf(states.dead().stream()
                        .map(BipModelTest::places)
                        .map(TreeSet::new)
                        .toList());
    }

    private static BipModel random(long seed) {
        var random = new Random(seed);
        var model = BipModel.named("seed" + seed);
        var types = new ArrayList<AtomType>();
        for (var i = 0; i < 1 + random.nextInt(3); i++) {
            types.add(randomType(random, "Type" + i));
        }
        var ports = new ArrayList<List<String>>();
        for (var i = 0; i < 2 + random.nextInt(4); i++) {
            var type = types.get(random.nextInt(types.size()));
            var name = "c" + i;
            model.component(name, type);
            ports.add(type.ports().stream().map(port -> name + "." + port).toList());
        }
        var connectors = 4 + random.nextInt(5);
        for (var i = 0; i < connectors; i++) {
            var ends = new ArrayList<String>();
            var triggers = random.nextInt(3) == 0;
            for (var some : ports) {
                if (random.nextInt(5) < 2) {
                    ends.add(some.get(random.nextInt(some.size())) + (triggers && random.nextInt(3) == 0 ? "'" : ""));
                }
            }
            if (ends.isEmpty()) {
                ends.add(ports.getFirst().getFirst());
            }
            model.connector("x" + i, ends.toArray(String[]::new));
        }
        for (var low = 0; low < connectors; low++) {
            for (var high = low + 1; high < connectors; high++) {
                if (random.nextInt(8) == 0) {
                    model.priority("x" + low, "x" + high);
                }
            }
        }
        return model.build();
    }

    /** A chain of places, so that all can be reached, with further steps. */
    private static AtomType randomType(Random random, String name) {
        var places = 1 + random.nextInt(3);
        var type = AtomType.starting(name, "q0").on("p0", "q0", "q" + (places > 1 ? 1 : 0));
        for (var i = 1; i < places; i++) {
            type = type.on("p" + random.nextInt(2), "q" + i, "q" + (i + 1) % places);
        }
        for (var i = 0; i < 3; i++) {
            try {
                type = type.on("p" + random.nextInt(3), "q" + random.nextInt(places), "q" + random.nextInt(places));
            } catch (IllegalArgumentException second) {
                continue; // there is a step on this port
            }
        }
        return type;
    }

    @ParameterizedTest
    @ValueSource(longs = {0, 1_000, 2_000, 3_000})
    void translation_ofRandomModels_hasTheSameStatesAndInteractions(long first) {
        var states = 0;
        for (var seed = first; seed < first + 250; seed++) {
            var model = random(seed);
            try {
                assertSame(model);
            } catch (AssertionError | RuntimeException wrong) {
                throw new AssertionError("seed " + seed + "\n" + BipText.of(model), wrong);
            }
            states += BipStates.explore(model).size();
        }
        assertThat(states).as("so that the models are not all trivial").isGreaterThan(1_000);
    }

    @Test
    void translation_ofThePapersModels_hasTheSameStatesAndInteractions() {
        assertSame(PaperBip.waiting());
        assertSame(PaperBip.notWaiting());
        assertSame(PaperBip.rulesAsPriorities());
    }

    @Test
    void translation_isSafeAndHasNoPriorities() {
        var net = BipNet.of(PaperBip.rulesAsPriorities()).net();

        assertThat(net.transitions()).allMatch(each -> each.priority() == 0);
        assertThat(net.transitions())
                .extracting(Transition::name)
                .contains("see12_by2")
                .doesNotContain("drive1_wanderer1");
    }
}
