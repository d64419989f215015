package io.troupe.petri.drawing;

import static io.troupe.petri.Nets.net;
import static io.troupe.petri.Nets.refused;
import static java.util.Objects.requireNonNull;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;
import static org.assertj.core.api.Assertions.assertThatIllegalStateException;

import io.troupe.petri.Arc;
import io.troupe.petri.Nets;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.PetriNet;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.ReachabilityGraph.State;
import io.troupe.petri.Transition;
import io.troupe.petri.drawing.DotReader.Statement;
import io.troupe.tools.Thorough;
import java.io.IOException;
import java.util.ArrayList;
import java.util.Collection;
import java.util.HashSet;
import java.util.List;
import java.util.Random;
import java.util.function.Predicate;
import java.util.function.Supplier;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** {@link NetDrawing} and {@link GraphDrawing}. */
class DrawingTest {
    private static final PetriNet UNCORRECTED = PaperNets.uncorrected(Reading.A);
    private static final ReachabilityGraph WHOLE = ReachabilityGraph.explore(UNCORRECTED);
    private static final ReachabilityGraph PAIR = ReachabilityGraph.explore(Nets.part("robot player", "Tr2 Tr4"));

    private static Picture picture(NetDrawing drawing) {
        return new Picture(drawing.svg());
    }

    private static Picture picture(GraphDrawing drawing) {
        return new Picture(drawing.svg());
    }

    private static List<String> names(Collection<?> parts) {
        return parts.stream().map(Object::toString).toList();
    }

    private static List<Statement> withNodes(List<Statement> statements, int nodes) {
        return statements.stream()
                .filter(statement -> statement.nodes().size() == nodes)
                .toList();
    }

    private static List<Statement> coloured(List<Statement> statements) {
        return statements.stream()
                .filter(each -> each.attributes().containsKey("color"))
                .toList();
    }

    // ---- nets

    /** The titles of the arcs of some transitions. */
    private static List<String> arcs(PetriNet net, Predicate<Transition> wanted) {
        var arcs = new ArrayList<String>();
        net.transitions().stream().filter(wanted).forEach(t -> {
            t.inputs().forEach(arc -> arcs.add(arc.place() + " → " + t + weight(arc)));
            t.outputs().forEach(arc -> arcs.add(t + " → " + arc.place() + weight(arc)));
        });
        return arcs;
    }

    private static String weight(Arc arc) {
        return arc.weight() == 1 ? "" : ", weight " + arc.weight();
    }

    @Test
    void svg_ofTheWholeNet_hasEveryPlaceTransitionAndArcOnce_andSaysWhatItIs() {
        var svg = NetDrawing.of(UNCORRECTED).svg();
        var picture = new Picture(svg);

        assertThat(picture.groups("place"))
                .flatExtracting(Picture::texts)
                .containsExactlyElementsOf(names(UNCORRECTED.places()));
        assertThat(picture.groups("transition"))
                .flatExtracting(Picture::texts)
                .containsExactlyElementsOf(names(UNCORRECTED.transitions()));
        assertThat(picture.titles("arc")).containsExactlyInAnyOrderElementsOf(arcs(UNCORRECTED, t -> true));
        assertThat(picture.groups("path")).isEmpty();
        assertThat(picture.title()).contains("uncorrected A", "{R1, P1, M1, S1}");
        assertThat(picture.attribute("role")).isEqualTo("img");
        assertThat(picture.attribute("aria-label")).isEqualTo(picture.title());
        // arrows are triangles instead of markers
        assertThat(svg).doesNotContain("marker");
        assertThat(picture.groups("arc"))
                .allSatisfy(arc -> assertThat(Picture.elements(arc, "path"))
                        .filteredOn(path -> path.getAttribute("class").equals("head"))
                        .hasSize(1));
    }

    @Test
    void netsOfThePaper_areInRows_soThatNamesCanBeReadOnAPage() {
        for (var reading : Reading.values()) {
            for (var net : List.of(PaperNets.uncorrected(reading), PaperNets.corrected(reading))) {
                var svg = NetDrawing.of(net).tinting(PaperNets.components(net)).svg();
                var wide = Double.parseDouble(svg.replaceFirst("(?s).*? width=\"([0-9.]+)\".*", "$1"));
                assertThat(NetSvg.FONT_PX * 830 / wide)
                        .as("px of a letter of " + net + " on a page of 830 px")
                        .isGreaterThan(8.9);
            }
        }
    }

    @Test
    void svg_withTheTraceToADeadlock_coloursJustThat() {
        var dead = WHOLE.dead().getFirst();
        var trace = dead.shortestTrace();
        var drawing = NetDrawing.of(UNCORRECTED).marked(dead.marking()).highlighting(trace);
        var picture = picture(drawing);
        assertThat(picture.coloured("transition")).containsExactlyInAnyOrderElementsOf(new HashSet<>(names(trace)));
        assertThat(picture.coloured("arc")).containsExactlyInAnyOrderElementsOf(arcs(UNCORRECTED, trace::contains));
        assertThat(picture.titles("place"))
                .filteredOn(title -> title.endsWith(": 1 token"))
                .containsExactlyInAnyOrder("P1: 1 token", "M1: 1 token", "S10: 1 token", "R7'': 1 token");
    }

    @ParameterizedTest
    @ValueSource(ints = {0, 1, 2, 3, 4, 5, 1234})
    void tokens_upToFour_areDots_moreAreANumber(int tokens) {
        var place = picture(NetDrawing.of(net("tokens", "p=" + tokens)))
                .groups("place")
                .getFirst();
        assertThat(Picture.texts(place)).isEqualTo(tokens <= 4 ? List.of("p") : List.of("" + tokens, "p"));
        assertThat(Picture.elements(place, "circle"))
                .hasSize(1 + (tokens <= 4 ? tokens : 0))
                .allMatch(dot -> Picture.box(place).contains(Picture.circle(dot)));
    }

    @Test
    void weightsAndPriorities_thatAreNotOneAndZero_areWritten() {
        var net = net("weights", "p=2 q", "t: 2*p > q").toBuilder()
                .priority("t", -3)
                .build();
        var picture = picture(NetDrawing.of(net));
        assertThat(picture.groups("arc")).flatExtracting(Picture::texts).containsExactly("2");
        assertThat(picture.groups("transition")).flatExtracting(Picture::texts).containsExactly("t", "priority -3");
        assertThat(NetDrawing.of(net).dot())
                .contains("p0 -> t0 [label=\"2\" ];", "t0 -> p1 [];", "\"t\\npriority -3\"");
    }

    @Test
    void dot_ofTheWholeNet_hasEveryNodeAndArcOnce_andColoursTheTrace() {
        var trace = WHOLE.dead().getFirst().shortestTrace();
        var statements =
                DotReader.read(NetDrawing.of(UNCORRECTED).highlighting(trace).dot());
        var expected = new ArrayList<>(names(UNCORRECTED.places()));
        expected.addAll(names(UNCORRECTED.transitions()));
        assertThat(withNodes(statements, 1).stream().skip(3))
                .extracting(node -> node.attributes().get("label").split("\n")[0])
                .containsExactlyElementsOf(expected);
        var edges = withNodes(statements, 2);
        assertThat(edges).hasSize(UNCORRECTED.arcCount()).doesNotHaveDuplicates();
        assertThat(coloured(edges)).hasSameSizeAs(arcs(UNCORRECTED, trace::contains));
    }

    @ParameterizedTest
    @ValueSource(
            strings = {"Tr2''", "say \"hi\"", "a\\", "\\N", "x\\\"y", "a<b>&lt;&amp;", "-> ; } [", "Größe 机器人 🤖", "]]>"
            })
    void nastyNames_areShownAsTheyAre(String name) {
        var other = name + "+";
        var net = PetriNet.builder(name)
                .place(name, 1)
                .transition(other)
                .arc(name, other)
                .build();
        var statements = DotReader.read(NetDrawing.of(net).dot());
        var picture = picture(NetDrawing.of(net));
        assertThat(statements.getFirst().attributes()).containsEntry("label", name);
        assertThat(statements.get(3).attributes()).containsEntry("label", name + "\n●");
        assertThat(statements.get(4).attributes()).containsEntry("label", other);
        assertThat(picture.groups("place")).flatExtracting(Picture::texts).containsExactly(name);
        assertThat(picture.groups("transition")).flatExtracting(Picture::texts).containsExactly(other);
        assertThat(picture.title()).startsWith(name + " (");
    }

    @Test
    void drawing_hasTheSameBytesAgain_andIsNotChangedByWhatIsMadeOfIt() {
        var net = PaperNets.corrected(Reading.A);
        var drawing = NetDrawing.of(net);
        var again = NetDrawing.of(PaperNets.corrected(Reading.A));
        var before = drawing.svg();
        var other = drawing.marked(net.marking("P4")).highlighting(net.transitions());
        assertThat(List.of(drawing.svg(), again.svg())).containsOnly(before);
        assertThat(drawing.dot()).isEqualTo(again.dot());
        assertThat(other.svg()).isNotEqualTo(before);
    }

    @Test
    void components_haveATintEach_andALegend_andMeldedTransitionsAreGrey() {
        var net = PaperNets.corrected(Reading.A);
        var plain = picture(NetDrawing.of(net));

        var picture = picture(NetDrawing.of(net).tinting(PaperNets.components(net)));

        assertThat(picture.fills("place"))
                .containsEntry("R1", "#fbd9a8")
                .containsEntry("P4", "#bfdcf5")
                .containsEntry("M8''", "#c9e8bd")
                .containsEntry("S10", "#e6cdea");
        assertThat(picture.fills("transition")).containsEntry("Tr1", "#fbd9a8").containsEntry("Tstop", "#eeeeee");
        assertThat(picture.texts()).contains("robot", "player", "middleware", "service");
        assertThat(picture.viewBox().bottom()).isGreaterThan(plain.viewBox().bottom());
        refused(
                () -> NetDrawing.of(PaperNets.robot()).tinting(PaperNets.components(net)),
                "place R3'' of component robot is not of net robot");
        double wide = plain.viewBox().right();
        assertThat(wide).isLessThan(1100);
        assertThat(plain.viewBox().bottom()).isLessThan(1300);
        assertThat(plain.groups("arc"))
                .as("an arc to another row goes back to its beginning, not around the picture")
                .allMatch(arc -> Picture.lengthOfFirstPath(arc) < 3 * wide);
    }

    @Test
    void markingOrTransition_ofAnotherNet_isRefused() {
        var drawing = NetDrawing.of(PaperNets.robot());
        var player = PaperNets.player();
        refused(() -> drawing.marked(player.initialMarking()), "place P1 of marking {P1} is not of net robot");
        assertThatIllegalArgumentException().isThrownBy(() -> drawing.marked(player.marking()));
        refused(() -> drawing.highlighting(player.transitions()), "transition Tp1 is not of net robot");
    }

    @Test
    void net_withoutAnything_isDrawn() {
        assertThat(picture(NetDrawing.of(net("nothing", ""))).groups("place")).isEmpty();
    }

    @Test
    void randomNets_areDrawnInsideTheViewBox_withoutOverlap() {
        for (var seed = 0; seed < Thorough.times(25, 150); seed++) {
            var net = Nets.any(new Random(seed));
            var picture = picture(NetDrawing.of(net));
            assertThat(picture.titles("arc"))
                    .as("seed " + seed)
                    .containsExactlyInAnyOrderElementsOf(arcs(net, t -> true));
            var nodes = new ArrayList<>(picture.groups("place"));
            nodes.addAll(picture.groups("transition"));
            assertThat(nodes).hasSize(net.places().size() + net.transitions().size());
            picture.requireApart(nodes, "seed " + seed);
        }
    }

    // ---- reachability graphs

    private static List<String> edges(ReachabilityGraph graph) {
        var edges = new ArrayList<String>();
        for (var state : graph.states()) {
            state.successors().forEach(edge -> edges.add(edge.transition() + ": " + state + " → " + edge.target()));
        }
        return edges;
    }

    /** The edges along the shortest trace, found by firing. */
    private static List<String> path(ReachabilityGraph graph, State end) {
        var path = new ArrayList<String>();
        var marking = graph.net().initialMarking();
        for (var transition : end.shortestTrace()) {
            var next = graph.net().fire(marking, transition);
            path.add(transition + ": " + marking + " → " + next);
            marking = next;
        }
        return path;
    }

    @Test
    void graphSvg_ofAPair_writesAllMarkingsAndTransitions_andColoursThePath() {
        var dead = PAIR.dead().getFirst();
        var picture = picture(GraphDrawing.of(PAIR));
        var coloured = picture(GraphDrawing.of(PAIR).pathTo(dead));

        assertThat(picture.groups("state")).hasSize(28);
        assertThat(picture.groups("state"))
                .extracting(state -> String.join(" ", Picture.texts(state)))
                .containsExactlyElementsOf(PAIR.states().stream()
                        .map(state -> state.toString().replaceAll("[{},]", ""))
                        .toList());
        assertThat(picture.titles("edge")).containsExactlyInAnyOrderElementsOf(edges(PAIR));
        assertThat(picture.groups("edge"))
                .allMatch(edge ->
                        Picture.title(edge).startsWith(Picture.texts(edge).getFirst() + ": "));
        assertThat(picture.titles("initial")).containsExactly("marking 0: {R1, P1}, initial");
        assertThat(Picture.elements(picture.groups("initial").getFirst(), "rect"))
                .hasSize(2);
        assertThat(picture.titles("dead")).singleElement().asString().endsWith(": {P1, R7''}, dead");
        assertThat(picture.groups("path")).isEmpty();
        picture.requireApart(picture.groups("state"), "pair");
        assertThat(coloured.coloured("edge")).hasSize(8).containsExactlyInAnyOrderElementsOf(path(PAIR, dead));
        assertThat(coloured.coloured("state")).hasSize(9);
        assertThat(coloured.titles("edge")).containsExactlyInAnyOrderElementsOf(edges(PAIR));
    }

    @Test
    void graphSvg_ofTheWholeNet_drawsAllMarkingsAsDots_andNamesThePath() {
        var dead = WHOLE.dead().getFirst();
        var picture = picture(GraphDrawing.of(WHOLE).pathTo(dead));
        assertThat(picture.groups("state")).hasSize(1264);
        assertThat(picture.titles("edge")).containsExactlyInAnyOrderElementsOf(edges(WHOLE));
        assertThat(picture.groups("dead")).hasSize(6);
        assertThat(picture.coloured("edge")).containsExactlyElementsOf(path(WHOLE, dead));
        assertThat(picture.groups("edge"))
                .flatExtracting(Picture::texts)
                .containsExactlyElementsOf(names(dead.shortestTrace()));
        picture.requireApart(picture.groups("state"), "whole net");
    }

    @Test
    void graphDot_hasEveryMarkingAndEdge_andColoursThePath() {
        var dead = PAIR.dead().getFirst();
        var statements = DotReader.read(GraphDrawing.of(PAIR).pathTo(dead).dot());
        var states = withNodes(statements, 1).subList(3, 31);
        var edges = withNodes(statements, 2);
        assertThat(withNodes(statements, 1)).hasSize(31);
        assertThat(states.getFirst().attributes())
                .containsEntry("label", "R1 P1")
                .containsEntry("peripheries", "2");
        assertThat(coloured(states)).hasSize(9);
        assertThat(edges).hasSize(43).doesNotHaveDuplicates();
        assertThat(coloured(edges))
                .extracting(edge -> edge.attributes().get("label"))
                .containsExactlyInAnyOrderElementsOf(names(dead.shortestTrace()));
    }

    @Test
    void graphDrawing_ofTheSameGraph_hasTheSameBytes() {
        var again = ReachabilityGraph.explore(PAIR.net());
        var drawing = GraphDrawing.of(PAIR).pathTo(PAIR.dead().getFirst());
        var second = GraphDrawing.of(again).pathTo(again.dead().getFirst());
        assertThat(drawing.svg()).isEqualTo(second.svg()).isEqualTo(drawing.svg());
        assertThat(drawing.dot()).isEqualTo(second.dot());
        assertThat(GraphDrawing.of(PAIR).svg()).isNotEqualTo(drawing.svg());
    }

    @Test
    void graph_tooLargeForSvg_isRefused_butWrittenAsDot() {
        var net = net("counter", "count", "more: > count");
        var drawing = GraphDrawing.of(ReachabilityGraph.explore(net, GraphDrawing.MOST_SVG_MARKINGS + 1));
        refused(
                drawing::svg,
                "the reachability graph of counter has 2001 markings, expected at most 2000 for an SVG drawing; dot()"
                        + " has no limit");
        assertThat(DotReader.read(drawing.dot())).hasSize(4 + 2001 + 2000 - 1);
    }

    @Test
    void state_ofAnotherGraph_isRefused() {
        var other = ReachabilityGraph.explore(PAIR.net()).states().get(3);
        assertThatIllegalArgumentException()
                .isThrownBy(() -> GraphDrawing.of(PAIR).pathTo(other))
                .withMessageContaining("is not of the graph robot player: 28 markings");
    }

    @Test
    void randomGraphs_areDrawnInsideTheViewBox_withoutOverlap() {
        for (var seed = 0; seed < 60; seed++) {
            var as = "seed " + seed;
            var graph = ReachabilityGraph.explore(Nets.any(new Random(seed)), 20 + 2 * seed);
            var end = graph.states().getLast();
            var picture = picture(GraphDrawing.of(graph).pathTo(end));
            assertThat(picture.titles("edge")).as(as).containsExactlyInAnyOrderElementsOf(edges(graph));
            assertThat(picture.coloured("edge")).as(as).containsExactlyInAnyOrderElementsOf(path(graph, end));
            assertThat(picture.groups("state")).hasSize(graph.size());
            assertThat(picture.groups("open")).hasSize(graph.openCount());
            picture.requireApart(picture.groups("state"), as);
        }
    }

    /** Loads our classes again, as if ELK were not on the class path. */
    private static final class WithoutElk extends ClassLoader {
        WithoutElk() {
            super(DrawingTest.class.getClassLoader());
        }

        @Override
        protected Class<?> loadClass(String name, boolean resolve) throws ClassNotFoundException {
            if (name.startsWith("org.eclipse.")) {
                throw new ClassNotFoundException(name);
            }
            if (!name.startsWith("io.troupe.petri.")) {
                return super.loadClass(name, resolve);
            }
            var known = findLoadedClass(name);
            return known == null ? define(name) : known;
        }

        private Class<?> define(String name) throws ClassNotFoundException {
            try (var in = getResourceAsStream(name.replace('.', '/') + ".class")) {
                var bytes = requireNonNull(in, name).readAllBytes();
                return defineClass(name, bytes, 0, bytes.length);
            } catch (IOException e) {
                throw new ClassNotFoundException(name, e);
            }
        }
    }

    static final class Drawn implements Supplier<String> {
        @Override
        public String get() {
            var drawing = NetDrawing.of(PetriNet.builder("n").place("a", 1).build());
            assertThat(drawing.dot()).contains("label=\"a");
            return assertThatIllegalStateException()
                    .isThrownBy(drawing::svg)
                    .actual()
                    .getMessage();
        }
    }

    @Test
    void svg_withoutElk_namesWhatIsMissing_andDotNeedsNone() throws ReflectiveOperationException {
        var drawn = new WithoutElk().loadClass(Drawn.class.getName()).getDeclaredConstructor();
        drawn.setAccessible(true);
        assertThat(((Supplier<?>) drawn.newInstance()).get())
                .isEqualTo("an SVG drawing needs org.eclipse.elk:org.eclipse.elk.alg.layered and"
                        + " org.eclipse.xtext:org.eclipse.xtext.xbase.lib on the class path, which troupe-verification"
                        + " does not bring along; dot() needs neither");
    }
}
