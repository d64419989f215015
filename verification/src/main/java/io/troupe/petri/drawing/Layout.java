package io.troupe.petri.drawing;

import java.util.ArrayList;
import java.util.EnumSet;
import java.util.List;
import org.eclipse.elk.alg.layered.LayeredLayoutProvider;
import org.eclipse.elk.alg.layered.options.CycleBreakingStrategy;
import org.eclipse.elk.alg.layered.options.LayeredOptions;
import org.eclipse.elk.alg.layered.options.NodePlacementStrategy;
import org.eclipse.elk.alg.layered.options.WrappingStrategy;
import org.eclipse.elk.core.data.LayoutMetaDataService;
import org.eclipse.elk.core.math.ElkPadding;
import org.eclipse.elk.core.options.Direction;
import org.eclipse.elk.core.options.EdgeRouting;
import org.eclipse.elk.core.options.NodeLabelPlacement;
import org.eclipse.elk.core.util.NullElkProgressMonitor;
import org.eclipse.elk.graph.ElkConnectableShape;
import org.eclipse.elk.graph.ElkEdge;
import org.eclipse.elk.graph.ElkNode;
import org.eclipse.elk.graph.ElkPort;
import org.eclipse.elk.graph.util.ElkGraphUtil;
import org.jspecify.annotations.Nullable;

/**
 * Positions everything in a {@link LayoutGraph} by the layered algorithm of the Eclipse Layout Kernel.
 *
 * <p><b>Order.</b> The same layoutGraph gets the same layout: the algorithm's random numbers have a fixed seed.
 */
final class Layout {
    private static final int SEED = 1;
    private static final double ASPECT_RATIO = 1.6;

    /**
     * The most nodes for the best node placement, which takes a minute for 250 nodes with many long arcs; larger graphs
     * use that of Brandes and Köpf, which is good and fast.
     */
    private static final int MOST_EXACT_NODES = 90;

    /** The most nodes for ELK's usual number of passes; more passes over larger graphs look the same. */
    private static final int MOST_NODES_FOR_ALL_PASSES = 500;

    /** Any text: it has no effect here, but ELK ignores empty labels. */
    private static final String TEXT = "label";

    private final Size size;
    private final List<PixelPoint> nodes = new ArrayList<>();
    private final List<PixelPoint> ports = new ArrayList<>();
    private final List<List<PixelPoint>> routes = new ArrayList<>();
    private final List<@Nullable PixelPoint> labels = new ArrayList<>();

    private Layout(Size size) {
        this.size = size;
    }

    static Layout of(LayoutGraph layoutGraph) {
        // makes ELK's registry find its options, which is needed once before they are read
        LayoutMetaDataService.getInstance(Layout.class.getClassLoader());
        var graph = ElkGraphUtil.createGraph();
        configure(graph, layoutGraph.style, layoutGraph.nodes.size());
        var nodes = layoutGraph.nodes.stream().map(node -> add(graph, node)).toList();
        var ports = layoutGraph.ports.stream()
                .map(port -> add(nodes.get(port.node()), port))
                .toList();
        var edges = layoutGraph.edges.stream()
                .map(edge -> add(
                        edge.fromPort() == null ? nodes.get(edge.from()) : ports.get(edge.fromPort()),
                        edge.toPort() == null ? nodes.get(edge.to()) : ports.get(edge.toPort()),
                        edge.label()))
                .toList();
        new LayeredLayoutProvider().layout(graph, new NullElkProgressMonitor());

        var layout = new Layout(new Size(graph.getWidth(), graph.getHeight()));
        nodes.forEach(node -> layout.nodes.add(new PixelPoint(node.getX(), node.getY())));
        ports.forEach(port -> layout.ports.add(new PixelPoint(
                port.getParent().getX() + port.getX(), port.getParent().getY() + port.getY())));
        edges.forEach(layout::read);
        return layout;
    }

    private static void configure(ElkNode graph, LayoutGraph.Style style, int nodes) {
        graph.setProperty(LayeredOptions.RANDOM_SEED, SEED);
        graph.setProperty(LayeredOptions.DIRECTION, style.downwards() ? Direction.DOWN : Direction.RIGHT);
        graph.setProperty(LayeredOptions.EDGE_ROUTING, EdgeRouting.ORTHOGONAL);
        graph.setProperty(LayeredOptions.SPACING_NODE_NODE, style.nodeSpacing());
        graph.setProperty(LayeredOptions.SPACING_NODE_NODE_BETWEEN_LAYERS, style.layerSpacing());
        graph.setProperty(LayeredOptions.SPACING_EDGE_NODE, style.edgeSpacing());
        graph.setProperty(LayeredOptions.SPACING_EDGE_NODE_BETWEEN_LAYERS, style.edgeSpacing());
        graph.setProperty(LayeredOptions.SPACING_EDGE_EDGE, style.edgeSpacing());
        graph.setProperty(LayeredOptions.SPACING_EDGE_EDGE_BETWEEN_LAYERS, style.edgeSpacing());
        graph.setProperty(LayeredOptions.PADDING, new ElkPadding(12));
        graph.setProperty(LayeredOptions.CYCLE_BREAKING_STRATEGY, style.order());
        boolean large = style.wrapped() || style.order() == CycleBreakingStrategy.BFS_NODE_ORDER;
        if (!large || nodes <= MOST_EXACT_NODES) {
            graph.setProperty(LayeredOptions.NODE_PLACEMENT_STRATEGY, NodePlacementStrategy.NETWORK_SIMPLEX);
        }
        if (nodes > MOST_NODES_FOR_ALL_PASSES) {
            graph.setProperty(LayeredOptions.THOROUGHNESS, 1);
        }
        if (style.wrapped()) {
            graph.setProperty(LayeredOptions.WRAPPING_STRATEGY, WrappingStrategy.MULTI_EDGE);
            graph.setProperty(LayeredOptions.ASPECT_RATIO, ASPECT_RATIO);
        }
    }

    private static ElkNode add(ElkNode graph, LayoutGraph.Node sketched) {
        var node = ElkGraphUtil.createNode(graph);
        node.setDimensions(sketched.size().width(), sketched.size().height());
        var caption = sketched.caption();
        if (caption != null) {
            node.setProperty(
                    LayeredOptions.NODE_LABELS_PLACEMENT,
                    EnumSet.of(NodeLabelPlacement.OUTSIDE, NodeLabelPlacement.V_BOTTOM, NodeLabelPlacement.H_CENTER));
            ElkGraphUtil.createLabel(TEXT, node).setDimensions(caption.width(), caption.height());
        }
        return node;
    }

    private static ElkPort add(ElkNode node, LayoutGraph.Port sketched) {
        var port = ElkGraphUtil.createPort(node);
        port.setDimensions(sketched.sidePx(), sketched.sidePx());
        return port;
    }

    private static ElkEdge add(ElkConnectableShape from, ElkConnectableShape to, @Nullable Size label) {
        var edge = ElkGraphUtil.createSimpleEdge(from, to);
        if (label != null) {
            ElkGraphUtil.createLabel(TEXT, edge).setDimensions(label.width(), label.height());
        }
        return edge;
    }

    private void read(ElkEdge edge) {
        var section = edge.getSections().get(0);
        var route = new ArrayList<PixelPoint>();
        route.add(new PixelPoint(section.getStartX(), section.getStartY()));
        section.getBendPoints().forEach(bend -> route.add(new PixelPoint(bend.getX(), bend.getY())));
        route.add(new PixelPoint(section.getEndX(), section.getEndY()));
        routes.add(List.copyOf(route));
        labels.add(
                edge.getLabels().isEmpty()
                        ? null
                        : new PixelPoint(
                                edge.getLabels().get(0).getX(),
                                edge.getLabels().get(0).getY()));
    }

    /** The size of the whole drawing, with a margin. */
    Size size() {
        return size;
    }

    /** The upper left corner of a node. */
    PixelPoint node(int number) {
        return nodes.get(number);
    }

    /** The upper left corner of a port. */
    PixelPoint port(int number) {
        return ports.get(number);
    }

    /** The points of an edge, from the border of one node's rectangle to that of the other. */
    List<PixelPoint> route(int edge) {
        return routes.get(edge);
    }

    /** The upper left corner of an edge's label, if it has one. */
    @Nullable
    PixelPoint label(int edge) {
        return labels.get(edge);
    }
}
