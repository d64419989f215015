package io.troupe.petri.drawing;

import io.troupe.petri.ReachabilityGraph.State;
import java.util.List;
import org.eclipse.elk.alg.layered.options.CycleBreakingStrategy;

/** Lays out and writes a reachability graph that is small enough to label all markings and edges. */
final class GraphSvg {
    private static final double FONT_PX = 12;
    private static final double EDGE_FONT_PX = 11;
    private static final double WRAP_PX = 90;
    private static final double GAP_PX = 3;
    private static final LayoutGraph.Style STYLE =
            new LayoutGraph.Style(true, false, CycleBreakingStrategy.MODEL_ORDER, 16, 18, 8);

    private final GraphContent content;
    private final Layout layout;
    private final Page page;

    GraphSvg(GraphContent content) {
        this.content = content;
        layout = Layout.of(layoutGraph());
        page = new Page(layout.size(), content.graph.toString(), FONT_PX);
    }

    private LayoutGraph layoutGraph() {
        var layoutGraph = new LayoutGraph(STYLE);
        content.states.forEach(state -> layoutGraph.node(size(state), null));
        content.edges.forEach(edge -> layoutGraph.edge(edge.from(), edge.to(), label(edge)));
        return layoutGraph;
    }

    private Size size(State state) {
        var border = content.isInitial(state) ? 2 * GAP_PX : 0;
        var text = TextMetrics.size(lines(state), FONT_PX);
        return new Size(Math.max(30, text.width() + 10) + border, text.height() + 8 + border);
    }

    private static List<String> lines(State state) {
        return TextMetrics.wrapped(GraphContent.words(state), FONT_PX, WRAP_PX);
    }

    private static Size label(GraphContent.Edge edge) {
        return TextMetrics.size(List.of(edge.transition().name()), EDGE_FONT_PX);
    }

    String write() {
        // coloured edges last, so that they lie on top
        for (var coloured : List.of(false, true)) {
            for (var i = 0; i < content.edges.size(); i++) {
                if (content.edges.get(i).onPath() == coloured) {
                    edge(i);
                }
            }
        }
        content.states.forEach(this::state);
        return page.end();
    }

    private void edge(int number) {
        var edge = content.edges.get(number);
        var colour = edge.onPath() ? Palette.PATH : Palette.LINE;
        page.group(edge.onPath() ? "edge path" : "edge", content.title(edge));
        page.arrow(layout.route(number), colour, edge.onPath() ? 2 : 1, 8);
        var corner = layout.label(number);
        var label = label(edge);
        if (corner != null) {
            var centre = new PixelPoint(corner.x() + label.width() / 2, corner.y() + label.height() / 2);
            page.lines(List.of(edge.transition().name()), centre, EDGE_FONT_PX, colour);
        }
        page.endGroup();
    }

    private void state(State state) {
        var corner = layout.node(state.index());
        var size = size(state);
        page.group(content.classes(state), content.title(state));
        border(state, corner, size);
        if (content.isInitial(state)) {
            border(
                    state,
                    new PixelPoint(corner.x() + GAP_PX, corner.y() + GAP_PX),
                    new Size(size.width() - 2 * GAP_PX, size.height() - 2 * GAP_PX));
        }
        var centre = new PixelPoint(corner.x() + size.width() / 2, corner.y() + size.height() / 2);
        page.lines(lines(state), centre, FONT_PX, "black");
        page.endGroup();
    }

    private void border(State state, PixelPoint corner, Size size) {
        page.add(
                "<rect x=\"%s\" y=\"%s\" width=\"%s\" height=\"%s\" rx=\"6\" fill=\"%s\" stroke=\"%s\" stroke-width=\"%s\" stroke-dasharray=\"%s\"/>",
                corner.x(),
                corner.y(),
                size.width(),
                size.height(),
                content.fill(state),
                content.isOnPath(state) ? Palette.PATH : Palette.LINE,
                content.isOnPath(state) ? 2 : 1,
                state.isOpen() ? "4 2" : "none");
    }
}
