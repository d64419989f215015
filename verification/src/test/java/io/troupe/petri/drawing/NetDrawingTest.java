package io.troupe.petri.drawing;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.petri.Arc;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.RandomNets;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.Transition;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Random;
import java.util.function.Predicate;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;
import org.w3c.dom.Element;

class NetDrawingTest {
    private static final PetriNet UNCORRECTED = PaperNets.uncorrected(Reading.A);

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
    void svg_ofTheWholeNet_hasEveryPlaceTransitionAndArcOnce() {
        var picture = new Picture(NetDrawing.of(UNCORRECTED).svg());

        assertThat(picture.groups("place"))
                .flatExtracting(Picture::texts)
                .containsExactlyElementsOf(
                        UNCORRECTED.places().stream().map(Place::name).toList());
        assertThat(picture.groups("transition"))
                .flatExtracting(Picture::texts)
                .containsExactlyElementsOf(
                        UNCORRECTED.transitions().stream().map(Transition::name).toList());
        assertThat(picture.titles("arc")).containsExactlyInAnyOrderElementsOf(arcs(UNCORRECTED, t -> true));
        assertThat(picture.groups("path")).isEmpty();
        assertThat(picture.title()).contains("uncorrected A").contains("{R1, P1, M1, S1}");
    }

    @Test
    void svg_withTheTraceToADeadlock_coloursJustThat() {
        var dead = ReachabilityGraph.explore(UNCORRECTED).dead().getFirst();
        var trace = dead.shortestTrace();

        var picture = new Picture(NetDrawing.of(UNCORRECTED)
                .marked(dead.marking())
                .highlighting(trace)
                .svg());

        assertThat(picture.groups("transition").stream()
                        .filter(group -> group.getAttribute("class").endsWith(" path"))
                        .map(Picture::title))
                .containsExactlyInAnyOrderElementsOf(
                        new HashSet<>(trace.stream().map(Transition::name).toList()));
        assertThat(picture.groups("arc").stream()
                        .filter(group -> group.getAttribute("class").endsWith(" path"))
                        .map(Picture::title))
                .containsExactlyInAnyOrderElementsOf(arcs(UNCORRECTED, trace::contains));
        assertThat(picture.titles("place").stream().filter(title -> title.endsWith(": 1 token")))
                .containsExactlyInAnyOrder("P1: 1 token", "M1: 1 token", "S10: 1 token", "R7'': 1 token");
    }

    @ParameterizedTest
    @ValueSource(ints = {0, 1, 2, 3, 4, 5, 1234})
    void tokens_upToFour_areDots_moreAreANumber(int tokens) {
        var net = PetriNet.builder("tokens").place("p", tokens).build();

        var place = new Picture(NetDrawing.of(net).svg()).groups("place").getFirst();

        assertThat(Picture.elements(place, "circle")).hasSize(1 + (tokens <= 4 ? tokens : 0));
        assertThat(Picture.texts(place)).isEqualTo(tokens <= 4 ? List.of("p") : List.of("" + tokens, "p"));
        assertThat(Picture.elements(place, "circle"))
                .allMatch(dot -> Picture.box(place).contains(Picture.box(wrapped(dot))));
    }

    /** A circle as if it were the first of a group. */
    private static Element wrapped(Element circle) {
        var group = circle.getOwnerDocument().createElement("g");
        group.appendChild(circle.cloneNode(true));
        return group;
    }

    @Test
    void weightsAndPriorities_thatAreNotOneAndZero_areWritten() {
        var net = PetriNet.builder("weights")
                .place("p", 2)
                .place("q")
                .transition("t")
                .arc("p", "t", 2)
                .arc("t", "q")
                .priority("t", -3)
                .build();

        var picture = new Picture(NetDrawing.of(net).svg());

        assertThat(picture.groups("arc")).flatExtracting(Picture::texts).containsExactly("2");
        assertThat(picture.groups("transition")).flatExtracting(Picture::texts).containsExactly("t", "priority -3");
        assertThat(NetDrawing.of(net).dot())
                .contains("p0 -> t0 [label=\"2\" ];")
                .contains("t0 -> p1 [];")
                .contains("\"t\\npriority -3\"");
    }

    @Test
    void dot_ofTheWholeNet_hasEveryNodeAndArcOnce_andColoursTheTrace() {
        var trace = ReachabilityGraph.explore(UNCORRECTED).dead().getFirst().shortestTrace();

        var statements =
                DotReader.read(NetDrawing.of(UNCORRECTED).highlighting(trace).dot());

        var nodes = statements.stream().filter(s -> s.nodes().size() == 1).skip(3);
        assertThat(nodes.map(node ->
                        node.attributes().get("label").lines().findFirst().orElseThrow()))
                .containsExactlyElementsOf(java.util.stream.Stream.concat(
                                UNCORRECTED.places().stream().map(Place::name),
                                UNCORRECTED.transitions().stream().map(Transition::name))
                        .toList());
        var edges = statements.stream().filter(s -> s.nodes().size() == 2).toList();
        assertThat(edges).hasSize(UNCORRECTED.arcCount()).doesNotHaveDuplicates();
        assertThat(edges.stream().filter(edge -> edge.attributes().containsKey("color")))
                .hasSize(arcs(UNCORRECTED, trace::contains).size());
    }

    @ParameterizedTest
    @ValueSource(
            strings = {"Tr2''", "say \"hi\"", "a\\", "\\N", "x\\\"y", "a<b>&lt;&amp;", "-> ; } [", "Größe 机器人 🤖", "]]>"
            })
    void nastyNames_areShownAsTheyAre(String name) {
        var net = PetriNet.builder(name)
                .place(name, 1)
                .transition(name + "+")
                .arc(name, name + "+")
                .build();

        var statements = DotReader.read(NetDrawing.of(net).dot());
        var picture = new Picture(NetDrawing.of(net).svg());

        assertThat(statements.getFirst().attributes()).containsEntry("label", name);
        assertThat(statements.get(3).attributes()).containsEntry("label", name + "\n●");
        assertThat(statements.get(4).attributes()).containsEntry("label", name + "+");
        assertThat(picture.groups("place")).flatExtracting(Picture::texts).containsExactly(name);
        assertThat(picture.groups("transition")).flatExtracting(Picture::texts).containsExactly(name + "+");
        assertThat(picture.title()).startsWith(name + " (");
    }

    @Test
    void drawing_ofTheSameNet_hasTheSameBytes() {
        var drawing = NetDrawing.of(PaperNets.corrected(Reading.A));
        var again = NetDrawing.of(PaperNets.corrected(Reading.A));

        assertThat(drawing.svg()).isEqualTo(again.svg()).isEqualTo(drawing.svg());
        assertThat(drawing.dot()).isEqualTo(again.dot());
    }

    @Test
    void drawing_isNotChangedByWhatIsMadeOfIt() {
        var drawing = NetDrawing.of(UNCORRECTED);
        var before = drawing.svg();

        var other = drawing.marked(UNCORRECTED.marking("P4")).highlighting(UNCORRECTED.transitions());

        assertThat(drawing.svg()).isEqualTo(before);
        assertThat(other.svg()).isNotEqualTo(before);
    }

    @Test
    void picture_saysWhatItIs_andHasTrianglesForArrows_insteadOfMarkers() {
        var svg = NetDrawing.of(UNCORRECTED).svg();
        var picture = new Picture(svg);

        assertThat(picture.attribute("role")).isEqualTo("img");
        assertThat(picture.attribute("aria-label")).isEqualTo(picture.title());
        assertThat(svg).doesNotContain("marker");
        assertThat(picture.groups("arc"))
                .allSatisfy(arc -> assertThat(Picture.elements(arc, "path").stream()
                                .filter(path -> path.getAttribute("class").equals("head")))
                        .hasSize(1));
    }

    @Test
    void arcs_ofTheWholeNet_areNoLongerThanThePictureIsWide() {
        var picture = new Picture(NetDrawing.of(PaperNets.corrected(Reading.A)).svg());

        assertThat(picture.viewBox().right()).isLessThan(1600);
        assertThat(picture.viewBox().bottom()).isLessThan(800);
        assertThat(picture.groups("arc").stream().mapToDouble(Picture::lengthOfFirstPath))
                .allSatisfy(px -> assertThat(px).isLessThan(1000));
    }

    @Test
    void components_haveATintEach_andALegend_andMeldedTransitionsAreGrey() {
        var net = PaperNets.corrected(Reading.A);

        var picture = new Picture(
                NetDrawing.of(net).tinting(PaperNets.components(net)).svg());

        assertThat(picture.fills("place")).containsEntry("R1", "#fbd9a8").containsEntry("P4", "#bfdcf5");
        assertThat(picture.fills("place")).containsEntry("M8''", "#c9e8bd").containsEntry("S10", "#e6cdea");
        assertThat(picture.fills("transition")).containsEntry("Tr1", "#fbd9a8").containsEntry("Tstop", "#eeeeee");
        assertThat(picture.texts()).contains("robot", "player", "middleware", "service");
        assertThat(picture.viewBox().bottom())
                .isGreaterThan(new Picture(NetDrawing.of(net).svg()).viewBox().bottom());
        assertThatThrownBy(() -> NetDrawing.of(PaperNets.robot()).tinting(PaperNets.components(net)))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("place R3'' of component robot is not of net robot");
    }

    @Test
    void markingOrTransition_ofAnotherNet_isRefused() {
        var drawing = NetDrawing.of(PaperNets.robot());
        var player = PaperNets.player();

        assertThatThrownBy(() -> drawing.marked(player.initialMarking()))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("place P1 of marking {P1} is not of net robot");
        assertThatThrownBy(() -> drawing.marked(player.marking())).isInstanceOf(IllegalArgumentException.class);
        assertThatThrownBy(() -> drawing.highlighting(player.transitions()))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("transition Tp1 is not of net robot");
    }

    @Test
    void net_withoutAnything_isDrawn() {
        var picture =
                new Picture(NetDrawing.of(PetriNet.builder("nothing").build()).svg());

        assertThat(picture.groups("place")).isEmpty();
    }

    @Test
    void randomNets_areDrawnInsideTheViewBox_withoutOverlap() {
        for (var seed = 0; seed < 150; seed++) {
            var net = RandomNets.any(new Random(seed));

            var picture = new Picture(NetDrawing.of(net).svg());

            assertThat(picture.titles("arc"))
                    .as("seed " + seed)
                    .containsExactlyInAnyOrderElementsOf(arcs(net, t -> true));
            var nodes = new ArrayList<>(picture.groups("place"));
            nodes.addAll(picture.groups("transition"));
            assertThat(nodes).hasSize(net.places().size() + net.transitions().size());
            Overlaps.requireApart(picture, nodes, "seed " + seed);
        }
    }
}
