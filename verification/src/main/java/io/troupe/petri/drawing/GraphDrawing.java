package io.troupe.petri.drawing;

import static java.util.Objects.requireNonNull;

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
        return new GraphDot(content()).write();
    }

    /**
     * A complete SVG file, laid out from top to bottom.
     *
     * @throws IllegalArgumentException if the graph has more than {@link #MOST_SVG_MARKINGS} markings or
     *     {@link #MOST_SVG_EDGES} edges
     */
    public String svg() {
        require(graph.size(), MOST_SVG_MARKINGS, "markings");
        require(graph.edgeCount(), MOST_SVG_EDGES, "edges");
        var content = content();
        return content.written ? new GraphSvg(content).write() : new GraphMapSvg(content).write();
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
}
