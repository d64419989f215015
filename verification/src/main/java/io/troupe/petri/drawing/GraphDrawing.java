package io.troupe.petri.drawing;

import static java.util.Objects.requireNonNull;

import io.troupe.drawing.Dot;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.ReachabilityGraph.State;
import org.jspecify.annotations.Nullable;

/**
 * A drawing of a reachability graph: the initial marking has a double border, dead markings are filled, open ones
 * dashed, and an optional shortest path is coloured.
 *
 * <p>In a graph of up to {@link #MOST_WRITTEN_MARKINGS} markings, all markings and transitions are labelled. In a
 * larger graph the markings are dots in rows, one row for each distance from the initial marking, and only the edges of
 * the path are labelled, at the left of their rows.
 *
 * <p><b>Role.</b> {@code GraphDrawing.of(graph).pathTo(graph.dead().getFirst()).svg()}.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Order.</b> The same graph and path give the same bytes.
 *
 * <p><b>Cost.</b> {@link #svg} takes some seconds for {@link #MOST_SVG_MARKINGS} markings.
 */
public final class GraphDrawing {
    /** The size of the largest graph whose markings and edges are all labelled. */
    public static final int MOST_WRITTEN_MARKINGS = 60;

    /** The size of the largest graph that {@link #svg} draws. */
    public static final int MOST_SVG_MARKINGS = 2000;

    /** The most edges of a graph that {@link #svg} draws. */
    public static final int MOST_SVG_EDGES = 6000;

    private final ReachabilityGraph graph;
    private final @Nullable State end;

    private GraphDrawing(ReachabilityGraph graph, @Nullable State end) {
        this.graph = graph;
        this.end = end;
    }

    /** The graph without a path. */
    public static GraphDrawing of(ReachabilityGraph graph) {
        return new GraphDrawing(requireNonNull(graph, "graph"), null);
    }

    /**
     * The same drawing with only the shortest path to this marking coloured.
     *
     * @throws IllegalArgumentException if the state is of another graph
     */
    public GraphDrawing pathTo(State state) {
        if (state.index() >= graph.size() || !graph.states().get(state.index()).equals(state)) {
            throw new IllegalArgumentException("state " + state + " is not of the graph " + graph);
        }
        return new GraphDrawing(graph, state);
    }

    /** DOT, which Graphviz lays out; for a graph of any size. */
    public String dot() {
        return new DotWriter(content()).write();
    }

    /**
     * A complete SVG file, laid out from top to bottom.
     *
     * @throws IllegalArgumentException if the graph has more than {@link #MOST_SVG_MARKINGS} markings or
     *     {@link #MOST_SVG_EDGES} edges
     * @throws IllegalStateException if ELK is not on the class path; the message names the artifacts
     */
    public String svg() {
        require(graph.size(), MOST_SVG_MARKINGS, "markings");
        require(graph.edgeCount(), MOST_SVG_EDGES, "edges");
        var content = content();
        return Elk.drawn(() -> content.written ? new GraphSvg(content).write() : new GraphMapSvg(content).write());
    }

    private GraphContent content() {
        return new GraphContent(graph, end, graph.size() <= MOST_WRITTEN_MARKINGS);
    }

    private void require(int count, int most, String what) {
        if (count > most) {
            throw new IllegalArgumentException(
                    "the reachability graph of " + graph.net().name() + " has " + count + " " + what
                            + ", expected at most " + most + " for an SVG drawing; dot() has no limit");
        }
    }

    /** Writes one reachability graph as DOT: the markings are s0, s1, .. in the order of the graph. */
    private static final class DotWriter {
        private final GraphContent content;
        private final StringBuilder dot = new StringBuilder();

        DotWriter(GraphContent content) {
            this.content = content;
        }

        String write() {
            var title = content.graph.toString();
            dot.append("digraph {\n  graph [label=").append(Dot.quoted(title)).append(", fontname=\"Helvetica\"];\n");
            dot.append("  node [fontname=\"Helvetica\", fontsize=11, margin=0.06, color=\"" + Palette.LINE + "\", ");
            dot.append(
                    content.written
                            ? "shape=box, style=\"rounded,filled\", fillcolor=\"white\", height=0.3];\n"
                            : "shape=circle, style=filled, fillcolor=\"white\", label=\"\", width=0.12, fixedsize=true];\n");
            dot.append("  edge [fontname=\"Helvetica\", fontsize=10, arrowsize=0.6, color=\"");
            dot.append(content.written ? Palette.LINE : Palette.FAINT).append("\"];\n");
            content.states.forEach(this::state);
            content.edges.forEach(this::edge);
            return dot.append("}\n").toString();
        }

        private void state(State state) {
            dot.append("  s").append(state.index()).append(" [");
            if (content.written) {
                dot.append("label=")
                        .append(Dot.quoted(String.join(" ", GraphContent.words(state))))
                        .append(' ');
            }
            dot.append("tooltip=").append(Dot.quoted(state + content.remarks(state)));
            dot.append(content.isInitial(state) ? " peripheries=2" : "");
            dot.append(content.isDead(state) ? " fillcolor=\"" + Palette.DEAD_FILL + "\"" : "");
            dot.append(state.isOpen() ? " style=\"dashed,filled\"" : "");
            dot.append(content.isOnPath(state) ? " color=\"" + Palette.PATH + "\" penwidth=2" : "");
            dot.append("];\n");
        }

        private void edge(GraphContent.Edge edge) {
            dot.append("  s")
                    .append(edge.from())
                    .append(" -> s")
                    .append(edge.to())
                    .append(" [");
            dot.append(
                    content.isNamed(edge)
                            ? "label=" + Dot.quoted(edge.transition().name()) + " "
                            : "");
            dot.append(edge.onPath() ? "color=\"" + Palette.PATH + "\" penwidth=2" : "");
            dot.append("];\n");
        }
    }
}
