package io.troupe.petri.drawing;

import java.util.ArrayList;
import java.util.List;
import org.eclipse.elk.alg.layered.options.CycleBreakingStrategy;
import org.jspecify.annotations.Nullable;

/**
 * What is to be laid out: how large everything is, and what is joined with what. Nodes and edges are known by their
 * number, in the order they are added.
 */
final class Sketch {
    /** What a node needs. */
    record Node(Size size, @Nullable Size caption) {}

    /** An edge between two nodes, given by their numbers. */
    record Edge(int from, int to, @Nullable Size label) {}

    /**
     * What differs between the drawings; spacings in pixels.
     *
     * @param downwards from top to bottom, not from left to right
     * @param wrapped goes on in a new row where one row would be too long; ELK cannot do that with labels of edges
     * @param order which edges go forward: {@code MODEL_ORDER} those to a node added later, {@code DEPTH_FIRST} as long
     *     a chain as there is, {@code BFS_NODE_ORDER} a node stands as near to the first ones as edges lead to it,
     *     which keeps a large net with many loops compact
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
    final List<Edge> edges = new ArrayList<>();

    Sketch(Style style) {
        this.style = style;
    }

    /** Adds a node; {@code caption} is the text below it. */
    void node(Size size, @Nullable Size caption) {
        nodes.add(new Node(size, caption));
    }

    void edge(int from, int to, @Nullable Size label) {
        edges.add(new Edge(from, to, label));
    }
}
