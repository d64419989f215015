package io.troupe.petri.drawing;

import java.util.ArrayList;
import java.util.List;
import org.eclipse.elk.alg.layered.options.CycleBreakingStrategy;
import org.jspecify.annotations.Nullable;

/**
 * The input of a layout: the sizes of the nodes, and which of them are joined. Nodes and edges are identified by their
 * number, in the order in which they are added.
 */
final class LayoutGraph {
    /** The size of a node and of the text below it. */
    record Node(Size size, @Nullable Size caption) {}

    /** An edge between two nodes, given by their numbers; it ends at ports if they are given. */
    record Edge(
            int from,
            int to,
            @Nullable Size label,
            @Nullable Integer fromPort,
            @Nullable Integer toPort) {}

    /**
     * A square on the left or right border of a node. Edges begin at it, or edges end at it: ELK fails at some ports
     * with both.
     */
    record Port(int node, double sidePx) {}

    /**
     * The settings that differ between the drawings; spacings in pixels.
     *
     * @param downwards from top to bottom instead of from left to right
     * @param wrapped continues in a new row where one row would be too long; ELK cannot do that with labels of edges
     * @param order which edges go forward. {@code MODEL_ORDER}: those to a node that was added later.
     *     {@code DEPTH_FIRST}: those of the longest chain. {@code BFS_NODE_ORDER}: a node is placed as near to the
     *     first ones as the edges allow, which keeps a large net with many loops compact.
     */
    record Style(
            boolean downwards,
            boolean wrapped,
            CycleBreakingStrategy order,
            double nodeSpacing,
            double layerSpacing,
            double edgeSpacing) {}

    final Style style;
    final List<Node> nodes = new ArrayList<>();
    final List<Port> ports = new ArrayList<>();
    final List<Edge> edges = new ArrayList<>();

    LayoutGraph(Style style) {
        this.style = style;
    }

    /** Adds a node; {@code caption} is the text below it. */
    void node(Size size, @Nullable Size caption) {
        nodes.add(new Node(size, caption));
    }

    void edge(int from, int to, @Nullable Size label) {
        edges.add(new Edge(from, to, label, null, null));
    }

    /** Adds a port to a node, and returns its number. */
    int port(int node, double sidePx) {
        ports.add(new Port(node, sidePx));
        return ports.size() - 1;
    }

    /** Adds an edge from a port to a node without ports. */
    void edgeFromPort(int port, int to) {
        edges.add(new Edge(ports.get(port).node(), to, null, port, null));
    }

    /** Adds an edge from a node without ports to a port. */
    void edgeToPort(int from, int port) {
        edges.add(new Edge(from, ports.get(port).node(), null, null, port));
    }
}
