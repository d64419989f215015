package io.troupe.petri;

import static io.troupe.petri.Nets.net;
import static io.troupe.petri.Nets.refused;
import static java.util.stream.Collectors.toSet;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalStateException;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.petri.drawing.NetDrawing;
import io.troupe.tools.Thorough;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;
import org.junit.jupiter.api.Test;

/**
 * Inhibitor arcs: firing, searches, structure and drawings. Nets with them are read and written in {@link PnmlTest}.
 */
class InhibitorTest {
    private static final PetriNet GUARDED = net("guarded", "p=2 q", "take: p > q").toBuilder()
            .transition("rest")
            .inhibitor("p", "rest", 2)
            .build();

    @Test
    void transition_isDisabledFromTheWeightOn() {
        var take = GUARDED.transition("take");
        var rest = GUARDED.transition("rest");
        var start = GUARDED.initialMarking();
        assertThat(GUARDED.enabled(start)).containsExactly(take);
        assertThat(GUARDED.enabled(GUARDED.fire(start, take))).containsExactly(take, rest);
        assertThatIllegalStateException()
                .isThrownBy(() -> GUARDED.fire(start, rest))
                .withMessage("transition rest may not fire in {2*p}: p holds 2, expected fewer than 2");
        assertThat(GUARDED.arcCount()).isEqualTo(3);
        assertThat(GUARDED.hasInhibitors()).isTrue();
        assertThat(GUARDED.toBuilder().build().sameStructureAs(GUARDED)).isTrue();
        assertThat(GUARDED.renamed("other", name -> name + ".1").structure())
                .contains("transition rest.1 0 [] -> [] unless [p.1*2]");
        assertThat(net("guarded", "p=2 q", "take: p > q", "rest: >").sameStructureAs(GUARDED))
                .isFalse();
    }

    @Test
    void inhibitorArc_thatIsWrong_isRefused() {
        var builder = net("n", "p", "t: p >").toBuilder().inhibitor("p", "t");
        refused(() -> builder.inhibitor("q", "t"), "net n: inhibitor arc q -> t: there is no place called q");
        refused(() -> builder.inhibitor("p", "u"), "net n: there is no transition called u");
        refused(() -> builder.inhibitor("p", "t", 0), "net n: inhibitor arc p -> t has weight 0, expected 1 or more");
        refused(
                () -> builder.inhibitor("p", "t", 2),
                "net n: inhibitor arc p -> t is there already; the smallest weight is enough");
    }

    /**
     * Asking keeps the inhibitor arcs of the request, accepting those of the offer; a fused step has the least weight.
     */
    @Test
    void composition_keepsInhibitorArcs() {
        var parts = net("parts", "a=1 b=1 full", "ask: a > a", "serve: b > b").toBuilder()
                .inhibitor("full", "ask", 2)
                .inhibitor("full", "serve", 3)
                .build();
        var melded = Composition.meld(parts, List.of(Meld.of("ask", "serve")));
        assertThat(melded.transition("ask''").inhibitors())
                .extracting(Arc::weight)
                .containsExactly(2);
        assertThat(melded.transition("ask/serve.accept").inhibitors())
                .extracting(Arc::weight)
                .containsExactly(3);
        assertThat(melded.transition("serve").inhibitors()).isEmpty();
        assertThat(melded.transition("ask/serve.answer").inhibitors()).isEmpty();
        assertThat(Composition.fuse(parts, "both", List.of("ask", "serve"))
                        .transition("both")
                        .inhibitors())
                .extracting(Arc::weight)
                .containsExactly(2);
    }

    @Test
    void drawings_endInACircle() {
        assertThat(NetDrawing.of(GUARDED).dot()).contains("  p0 -> t1 [arrowhead=odot label=\"2\" ];\n");
        assertThat(NetDrawing.of(GUARDED).highlighting(GUARDED.transitions()).svg())
                .contains("<g class=\"inhibitor arc path\"><title>p inhibits rest, weight 2</title>")
                .contains("<circle class=\"head\"");
    }

    /** A search that shares no code with the main code: markings as lists, and enabling spelled out. */
    private static Map<List<Long>, Set<Integer>> bruteForce(PetriNet net, int limit) {
        var edges = new HashMap<List<Long>, Set<Integer>>();
        var first = net.places().stream().map(Place::tokens).toList();
        var queue = new ArrayDeque<>(List.of(first));
        edges.put(first, new HashSet<>());
        while (!queue.isEmpty() && edges.size() <= limit) {
            var marking = queue.remove();
            var ready = net.transitions().stream()
                    .filter(t -> t.inputs().stream()
                            .allMatch(arc -> marking.get(arc.place().index()) >= arc.weight()))
                    .filter(t -> t.inhibitors().stream()
                            .noneMatch(arc -> marking.get(arc.place().index()) >= arc.weight()))
                    .toList();
            var top = ready.stream().mapToInt(Transition::priority).max().orElse(0);
            for (var t : ready) {
                if (t.priority() == top) {
                    var next = new ArrayList<>(marking);
                    t.inputs()
                            .forEach(arc -> next.set(
                                    arc.place().index(), next.get(arc.place().index()) - arc.weight()));
                    t.outputs()
                            .forEach(arc -> next.set(
                                    arc.place().index(), next.get(arc.place().index()) + arc.weight()));
                    edges.get(marking).add(t.index());
                    if (edges.putIfAbsent(next, new HashSet<>()) == null) {
                        queue.add(next);
                    }
                }
            }
        }
        return edges;
    }

    private static List<Long> list(Marking marking) {
        return Arrays.stream(marking.toArray()).boxed().toList();
    }

    private static String arc(String attributes, String children) {
        return """
                <pnml xmlns="http://www.pnml.org/version-2009/grammar/pnml"><net id="n"
                type="http://www.pnml.org/version-2009/grammar/ptnet"><page id="g"><place id="p"/><transition id="t"/>
                <arc id="a" source="p" target="t" %s>%s</arc></page></net></pnml>
                """.formatted(attributes, children);
    }

    @Test
    void arcOfTwoKinds_isRefused_andAnInhibitorOfAToolIsTold() {
        for (var text : List.of(
                arc("type='inhibitor'", "<type value='normal'/>"),
                arc("type='normal'", "<type value='inhibitor'/>"),
                arc("type='inhibitor' arctype='normal'", ""),
                arc("", "<type value='inhibitor'/><arctype><text>normal</text></arctype>"))) {
            assertThatThrownBy(() -> Pnml.parse("x", text))
                    .isInstanceOf(PnmlException.class)
                    .hasMessage("x:3: arc a is an inhibitor arc and a normal one, expected one kind");
        }
        for (var text : List.of(arc("type='inhibitor'", "<type value='inhibitor'/>"), arc("arctype='inhibitor'", ""))) {
            assertThat(Pnml.parse("x", text).transition("t").inhibitors()).hasSize(1);
        }
        for (var inside : List.of("<arcType>inhibitor</arcType>", "<inhibitor/>", "<type value='inhibitor'/>")) {
            var warnings = new ArrayList<String>();
            var text = arc("", "<toolspecific tool='Snoopy' version='1'>" + inside + "</toolspecific>");
            var net = Pnml.parse("x", text, warnings::add);
            assertThat(net.transition("t").inhibitors()).isEmpty();
            assertThat(warnings)
                    .containsExactly(
                            "x:3: what the tool \"Snoopy\" has written about an inhibitor in arc a is left out, expected"
                                    + " type=\"inhibitor\" at the arc");
        }
    }

    @Test
    void searches_ofRandomNetsWithInhibitorArcs_agreeWithBruteForce() {
        var compared = 0;
        var reduced = 0;
        var withDead = 0;
        var changed = 0;
        for (var seed = 1L; seed <= Thorough.times(300, 3_000); seed++) {
            var random = new Random(seed);
            var plain = Nets.any(random);
            var net = Nets.inhibited(plain, random);
            var limits = SearchLimits.markings(2000);
            var expected = bruteForce(net, 2000);
            if (expected.size() > 2000 || !net.hasInhibitors()) {
                continue;
            }
            compared++;
            var graph = ReachabilityGraph.explore(net, limits);
            assertThat(graph.states()).as("seed %d", seed).hasSameSizeAs(expected.keySet());
            for (var state : graph.states()) {
                assertThat(state.successors().stream()
                                .map(edge -> edge.transition().index())
                                .collect(toSet()))
                        .as("seed %d", seed)
                        .isEqualTo(expected.get(list(state.marking())));
            }
            var dead = expected.keySet().stream()
                    .filter(marking -> expected.get(marking).isEmpty())
                    .collect(toSet());
            var search = DeadlockSearch.run(net, limits);
            assertThat(search.deadlocks().stream()
                            .map(deadlock -> list(deadlock.marking()))
                            .collect(toSet()))
                    .as("seed %d", seed)
                    .isEqualTo(dead);
            var lost = Liveness.of(graph).terminalComponents().stream()
                    .map(component -> Set.copyOf(component.neverFired()))
                    .filter(transitions -> !transitions.isEmpty())
                    .collect(toSet());
            assertThat(ProgressSearch.run(net, limits).losses().stream()
                            .map(loss -> Set.copyOf(loss.lost()))
                            .collect(toSet()))
                    .as("losses of seed %d", seed)
                    .isEqualTo(lost);
            assertThat(Pnml.parse("x", Pnml.toText(net)).sameStructureAs(net)).isTrue();
            reduced += search.visitedMarkings() < graph.size() ? 1 : 0;
            withDead += dead.isEmpty() ? 0 : 1;
            changed += ReachabilityGraph.explore(plain, limits).dead().size() != dead.size() ? 1 : 0;
        }
        assertThat(List.of(compared, reduced, withDead, changed))
                .as("nets, reduced, with dead markings, with others than without the inhibitor arcs")
                .satisfiesExactly(
                        count -> assertThat(count).isGreaterThan(Thorough.times(50, 1_000)),
                        count -> assertThat(count).isGreaterThan(Thorough.times(15, 300)),
                        count -> assertThat(count).isGreaterThan(Thorough.times(15, 300)),
                        count -> assertThat(count).isGreaterThan(Thorough.times(5, 100)));
    }
}
