package io.troupe.petri.drawing;

import io.troupe.petri.ReachabilityGraph.State;
import java.util.Arrays;
import java.util.List;
import org.eclipse.elk.alg.layered.options.CycleBreakingStrategy;

/**
 * Writes a reachability graph that is too large for labels as dots in rows, one row for each distance from the initial
 * marking.
 *
 * <p>Only the edges to the next row take part in the layout. The others, which are bent and in another colour, would
 * distort it.
 */
final class GraphMapSvg {
    private static final double FONT_PX = 12;
    private static final double RADIUS = 4;
    private static final double MARGIN = 14;
    private static final double FLATTEST_ROWS = 26;
    private static final double STEEPEST_ROWS = 70;
    /** Height over width, as far as the rows allow. */
    private static final double SHAPE = 0.75;

    private static final LayoutGraph.Style STYLE =
            new LayoutGraph.Style(true, false, CycleBreakingStrategy.MODEL_ORDER, 5, 10, 1);

    private final GraphContent content;
    private final int[] distances;
    private final PixelPoint[] centres;
    private final double left;
    private final double row;
    private final Size size;
    private final Page page;

    GraphMapSvg(GraphContent content) {
        this.content = content;
        distances = distances();
        var layout = Layout.of(layoutGraph());
        var rows = Arrays.stream(distances).max().orElse(0) + 1;
        var width = layout.size().width();
        row = Math.clamp(width * SHAPE / rows, FLATTEST_ROWS, STEEPEST_ROWS);
        left = MARGIN
                + content.edges.stream()
                        .filter(GraphContent.Edge::onPath)
                        .mapToDouble(edge -> TextMetrics.width(edge.transition().name(), FONT_PX))
                        .max()
                        .orElse(0);
        centres = content.states.stream()
                .map(state -> new PixelPoint(
                        left + layout.node(state.index()).x() + RADIUS, MARGIN + row * distances[state.index()]))
                .toArray(PixelPoint[]::new);
        size = new Size(left + width, 2 * MARGIN + row * (rows - 1));
        page = new Page(size, content.graph.toString(), FONT_PX);
    }

    /**
     * The distance of each marking. The graph is in breadth-first order, so the first edge into a marking comes from
     * the row above.
     */
    private int[] distances() {
        var found = new int[content.states.size()];
        for (var edge : content.edges) {
            if (edge.to() != 0 && found[edge.to()] == 0) {
                found[edge.to()] = found[edge.from()] + 1;
            }
        }
        return found;
    }

    private LayoutGraph layoutGraph() {
        var layoutGraph = new LayoutGraph(STYLE);
        content.states.forEach(state -> layoutGraph.node(new Size(2 * RADIUS, 2 * RADIUS), null));
        content.edges.stream().filter(this::isForward).forEach(edge -> layoutGraph.edge(edge.from(), edge.to(), null));
        return layoutGraph;
    }

    private boolean isForward(GraphContent.Edge edge) {
        return distances[edge.to()] == distances[edge.from()] + 1;
    }

    String write() {
        // backward edges first and the path last, which then lies on top
        content.edges.stream().filter(edge -> !isForward(edge)).forEach(edge -> edge(edge, Palette.BACK));
        content.edges.stream()
                .filter(edge -> isForward(edge) && !edge.onPath())
                .forEach(edge -> edge(edge, Palette.FAINT));
        content.edges.stream().filter(GraphContent.Edge::onPath).forEach(edge -> edge(edge, Palette.PATH));
        content.states.forEach(this::state);
        return page.end();
    }

    private void edge(GraphContent.Edge edge, String colour) {
        page.group(edge.onPath() ? "edge path" : isForward(edge) ? "edge" : "edge back", content.title(edge));
        double width = edge.onPath() ? 2 : 0.5;
        double head = edge.onPath() ? 8 : 4;
        if (isForward(edge)) {
            page.arrow(straight(edge), colour, width, head);
        } else {
            page.arrow(bent(edge), colour, width, head);
        }
        if (edge.onPath()) {
            var middle = (centres[edge.from()].y() + centres[edge.to()].y()) / 2;
            page.add(
                    "<text x=\"%s\" y=\"%s\" fill=\"%s\">%s</text>\n",
                    MARGIN / 2,
                    middle + FONT_PX * 0.35,
                    colour,
                    edge.transition().name());
        }
        page.endGroup();
    }

    private List<PixelPoint> straight(GraphContent.Edge edge) {
        var from = centres[edge.from()];
        var to = centres[edge.to()];
        return List.of(towards(from, to), towards(to, from));
    }

    /**
     * A curve that deviates from the straight line by a tenth, so that edges in both directions stay apart; a loop for
     * an edge from a marking to itself.
     */
    private Page.Curve bent(GraphContent.Edge edge) {
        var from = centres[edge.from()];
        var to = centres[edge.to()];
        if (edge.from() == edge.to()) {
            var side = from.x() + RADIUS;
            return new Page.Curve(
                    new PixelPoint(side, from.y() - 1),
                    new PixelPoint(side + 2 * RADIUS, from.y() - 2 * RADIUS),
                    new PixelPoint(side + 2 * RADIUS, from.y() + 2 * RADIUS),
                    new PixelPoint(side, from.y() + 1));
        }
        var x = (from.x() + to.x()) / 2 + (to.y() - from.y()) * 0.1;
        var y = (from.y() + to.y()) / 2 - (to.x() - from.x()) * 0.1;
        var bend = new PixelPoint(Math.clamp(x, left, size.width()), Math.clamp(y, 0, size.height()));
        return new Page.Curve(towards(from, bend), bend, bend, towards(to, bend));
    }

    /** The point where the line from the centre of a dot to another point leaves the dot. */
    private static PixelPoint towards(PixelPoint centre, PixelPoint other) {
        var dx = other.x() - centre.x();
        var dy = other.y() - centre.y();
        var length = Math.max(Math.hypot(dx, dy), RADIUS);
        return new PixelPoint(centre.x() + dx / length * RADIUS, centre.y() + dy / length * RADIUS);
    }

    private void state(State state) {
        page.group(content.classes(state), content.title(state));
        dot(state, RADIUS);
        if (content.isInitial(state)) {
            dot(state, RADIUS - 2);
        }
        page.endGroup();
    }

    private void dot(State state, double radius) {
        var centre = centres[state.index()];
        page.add(
                "<circle cx=\"%s\" cy=\"%s\" r=\"%s\" fill=\"%s\" stroke=\"%s\" stroke-width=\"%s\" stroke-dasharray=\"%s\"/>",
                centre.x(),
                centre.y(),
                radius,
                content.fill(state),
                content.isOnPath(state) ? Palette.PATH : Palette.LINE,
                content.isOnPath(state) ? 1.5 : 0.8,
                state.isOpen() ? "2 1" : "none");
    }
}
