package io.troupe.petri.drawing;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.petri.Composition;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.PetriNet;
import io.troupe.petri.RandomNets;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.ReachabilityGraph.State;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import org.junit.jupiter.api.Test;

class GraphDrawingTest {
    private static final ReachabilityGraph PAIR = ReachabilityGraph.explore(Composition.compose(
            "robot and player",
            List.of(PaperNets.robot(), PaperNets.player()),
            List.of(PaperNets.getProxies(), PaperNets.setValues())));

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

    private static List<String> coloured(Picture picture, String word) {
        return picture.groups(word).stream()
                .filter(group -> List.of(group.getAttribute("class").split(" ")).contains("path"))
                .map(Picture::title)
                .toList();
    }

    @Test
    void svg_ofAPair_writesAllMarkingsAndTransitions() {
        var picture = new Picture(GraphDrawing.of(PAIR).svg());

        assertThat(picture.groups("state")).hasSize(28);
        assertThat(picture.groups("state").stream().map(state -> String.join(" ", Picture.texts(state))))
                .containsExactlyElementsOf(PAIR.states().stream()
                        .map(state -> state.toString().replaceAll("[{},]", ""))
                        .toList());
        assertThat(picture.titles("edge")).containsExactlyInAnyOrderElementsOf(edges(PAIR));
        assertThat(picture.groups("edge"))
                .allSatisfy(edge -> assertThat(Picture.title(edge))
                        .startsWith(Picture.texts(edge).getFirst() + ": "));
        assertThat(picture.titles("initial")).containsExactly("marking 0: {R1, P1}, initial");
        assertThat(Picture.elements(picture.groups("initial").getFirst(), "rect"))
                .hasSize(2);
        assertThat(picture.titles("dead")).singleElement().asString().endsWith(": {P1, R7''}, dead");
        assertThat(picture.groups("path")).isEmpty();
        Overlaps.requireApart(picture, picture.groups("state"), "pair");
    }

    @Test
    void svg_withThePathToTheDeadlock_coloursJustThat() {
        var dead = PAIR.dead().getFirst();

        var picture = new Picture(GraphDrawing.of(PAIR).pathTo(dead).svg());

        assertThat(coloured(picture, "edge")).hasSize(8).containsExactlyInAnyOrderElementsOf(path(PAIR, dead));
        assertThat(coloured(picture, "state")).hasSize(9);
        assertThat(picture.titles("edge")).containsExactlyInAnyOrderElementsOf(edges(PAIR));
    }

    @Test
    void svg_ofTheWholeNet_drawsAllMarkingsAsDots_andNamesThePath() {
        var graph = ReachabilityGraph.explore(PaperNets.uncorrected(Reading.A));
        var dead = graph.dead().getFirst();

        var picture = new Picture(GraphDrawing.of(graph).pathTo(dead).svg());

        assertThat(picture.groups("state")).hasSize(1264);
        assertThat(picture.titles("edge")).containsExactlyInAnyOrderElementsOf(edges(graph));
        assertThat(picture.groups("dead")).hasSize(6);
        assertThat(coloured(picture, "edge")).containsExactlyElementsOf(path(graph, dead));
        assertThat(picture.groups("edge").stream().flatMap(edge -> Picture.texts(edge).stream()))
                .containsExactlyElementsOf(
                        dead.shortestTrace().stream().map(Object::toString).toList());
        Overlaps.requireApart(picture, picture.groups("state"), "whole net");
    }

    @Test
    void dot_hasEveryMarkingAndEdge_andColoursThePath() {
        var statements = DotReader.read(
                GraphDrawing.of(PAIR).pathTo(PAIR.dead().getFirst()).dot());

        var states =
                statements.stream().filter(s -> s.nodes().size() == 1).skip(3).toList();
        var edges = statements.stream().filter(s -> s.nodes().size() == 2).toList();
        assertThat(states).hasSize(28);
        assertThat(states.getFirst().attributes())
                .containsEntry("label", "R1 P1")
                .containsEntry("peripheries", "2");
        assertThat(states.stream().filter(s -> s.attributes().containsKey("color")))
                .hasSize(9);
        assertThat(edges).hasSize(43).doesNotHaveDuplicates();
        assertThat(edges.stream()
                        .filter(edge -> edge.attributes().containsKey("color"))
                        .map(edge -> edge.attributes().get("label")))
                .containsExactlyInAnyOrderElementsOf(PAIR.dead().getFirst().shortestTrace().stream()
                        .map(Object::toString)
                        .toList());
    }

    @Test
    void drawing_ofTheSameGraph_hasTheSameBytes() {
        var again = ReachabilityGraph.explore(PAIR.net());
        var drawing = GraphDrawing.of(PAIR).pathTo(PAIR.dead().getFirst());
        var second = GraphDrawing.of(again).pathTo(again.dead().getFirst());

        assertThat(drawing.svg()).isEqualTo(second.svg()).isEqualTo(drawing.svg());
        assertThat(drawing.dot()).isEqualTo(second.dot());
        assertThat(GraphDrawing.of(PAIR).svg()).isNotEqualTo(drawing.svg());
    }

    @Test
    void graph_tooLargeForSvg_isRefused_butWrittenAsDot() {
        var net = PetriNet.builder("counter")
                .place("count")
                .transition("more", List.of(), List.of("count"))
                .build();
        var drawing = GraphDrawing.of(ReachabilityGraph.explore(net, GraphDrawing.MOST_SVG_MARKINGS + 1));

        assertThatThrownBy(drawing::svg)
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("the reachability graph of counter has 2001 markings, expected at most 2000 for an SVG "
                        + "drawing; dot() has no limit");
        assertThat(DotReader.read(drawing.dot())).hasSize(4 + 2001 + 2000 - 1);
    }

    @Test
    void state_ofAnotherGraph_isRefused() {
        var other = ReachabilityGraph.explore(PAIR.net());

        assertThatThrownBy(() -> GraphDrawing.of(PAIR).pathTo(other.states().get(3)))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("is not of the graph robot and player: 28 markings");
    }

    @Test
    void randomGraphs_areDrawnInsideTheViewBox_withoutOverlap() {
        for (var seed = 0; seed < 60; seed++) {
            var graph = ReachabilityGraph.explore(RandomNets.any(new Random(seed)), 20 + 2 * seed);
            var end = graph.states().getLast();

            var picture = new Picture(GraphDrawing.of(graph).pathTo(end).svg());

            assertThat(picture.titles("edge")).as("seed " + seed).containsExactlyInAnyOrderElementsOf(edges(graph));
            assertThat(coloured(picture, "edge"))
                    .as("seed " + seed)
                    .containsExactlyInAnyOrderElementsOf(path(graph, end));
            assertThat(picture.groups("state")).hasSize(graph.size());
            assertThat(picture.groups("open")).hasSize(graph.openCount());
            Overlaps.requireApart(picture, picture.groups("state"), "seed " + seed);
        }
    }
}
