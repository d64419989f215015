package io.troupe.petri.drawing;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.bip.AtomType;
import io.troupe.petri.bip.BipModel;
import io.troupe.petri.bip.Connector;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import org.eclipse.elk.alg.layered.options.CycleBreakingStrategy;
import org.jspecify.annotations.Nullable;

/**
 * A drawing of a BIP model: a box for each component, with its automaton inside and its ports on the border, and a line
 * from each connector to the ports that it joins. A line ends with a bullet at a synchron and with a triangle at a
 * trigger; priorities are listed below.
 *
 * {@snippet :
 * Files.writeString(file, BipDrawing.of(PaperBip.waiting()).svg());
 * }
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Order.</b> The same model gives the same bytes.
 */
public final class BipDrawing {
    /** The most components and connectors that {@link #svg} draws. */
    public static final int MOST_SVG_PARTS = 300;

    private final BipModel model;

    private BipDrawing(BipModel model) {
        this.model = model;
    }

    public static BipDrawing of(BipModel model) {
        return new BipDrawing(requireNonNull(model, "model"));
    }

    /** Whether a model is small enough for {@link #svg}. */
    public static boolean canDraw(BipModel model) {
        return model.components().size() + model.connectors().size() <= MOST_SVG_PARTS;
    }

    /**
     * A complete SVG file. The components are in two columns with the connectors between them, if each connector has
     * its first port on one side and its others on the other side; otherwise they are laid out from left to right.
     *
     * @throws IllegalArgumentException if the model has more than {@link #MOST_SVG_PARTS} components and connectors
     * @throws IllegalStateException if ELK is not on the class path; the message names the artifacts
     */
    public String svg() {
        if (!canDraw(model)) {
            throw new IllegalArgumentException("model " + model + " has "
                    + (model.components().size() + model.connectors().size())
                    + " components and connectors, expected at most " + MOST_SVG_PARTS + " for a drawing");
        }
        return Elk.drawn(() -> new ModelSvg(model).write());
    }

    /** Lays out and writes one model. */
    private static final class ModelSvg {
        private static final double FONT_PX = 13;
        private static final double SMALL_PX = 12;
        private static final double PORT_PX = 8;
        private static final double PADDING_PX = 8;
        private static final double TITLE_PX = 24;
        private static final double ROW_PX = 17;
        private static final double MARK_PX = 9;
        private static final double MARGIN_PX = 12;

        private final BipModel model;
        private final List<String> components;
        private final Map<AtomType, AutomatonSvg> automata = new LinkedHashMap<>();
        private final Map<AtomType, String> tints = new HashMap<>();
        private final Map<String, Integer> ports = new LinkedHashMap<>();
        /** The components on the left; empty if they cannot be divided. */
        private final Optional<Set<String>> onTheLeft;

        private final Map<String, Boolean> portsThatBegin;
        private final Layout layout;
        private final Page page;

        ModelSvg(BipModel model) {
            this.model = model;
            components = List.copyOf(model.components().keySet());
            for (var type : model.types()) {
                automata.put(type, new AutomatonSvg(type));
                tints.put(type, Palette.TINTS.get(tints.size() % Palette.TINTS.size()));
            }
            onTheLeft = dividedInTwo(model);
            portsThatBegin = portsThatBegin();
            layout = Layout.of(layoutGraph());
            var below = model.priorities().isEmpty()
                    ? 0
                    : ROW_PX * (model.priorities().size() + 1);
            page = new Page(
                    new Size(
                            Math.max(layout.size().width(), widestPriority()),
                            layout.size().height() + below),
                    model.toString(),
                    FONT_PX);
        }

        /**
         * The components on the left if all can be divided so that each connector has its first end on one side and its
         * others on the other: the first component is on the left, and whatever is joined with it follows.
         */
        private static Optional<Set<String>> dividedInTwo(BipModel model) {
            var left = new HashMap<String, Boolean>();
            for (var component : model.components().keySet()) {
                if (left.putIfAbsent(component, true) == null && !follow(model, left)) {
                    return Optional.empty();
                }
            }
            left.values().removeIf(each -> !each);
            return Optional.of(Set.copyOf(left.keySet()));
        }

        /** Gives a side to everything that is joined with what has one; false if something would have two. */
        private static boolean follow(BipModel model, Map<String, Boolean> left) {
            int known;
            do {
                known = left.size();
                for (var connector : model.connectors()) {
                    var ends = connector.ends();
                    for (var i = 1; i < ends.size(); i++) {
                        if (!areOpposite(
                                ends.getFirst().component(), ends.get(i).component(), left)) {
                            return false;
                        }
                    }
                }
            } while (left.size() > known);
            return true;
        }

        /** Gives the other side to the one without a side; false if both have the same. */
        private static boolean areOpposite(String first, String second, Map<String, Boolean> left) {
            Boolean side = left.get(first);
            if (side != null) {
                Boolean other = left.putIfAbsent(second, !side);
                return other == null || !other.equals(side);
            }
            Boolean other = left.get(second);
            if (other != null) {
                left.put(first, !other);
            }
            return true;
        }

        /**
         * By the text of an end, whether its lines go from the port to the right, to connectors; each port has one way.
         */
        private Map<String, Boolean> portsThatBegin() {
            var begin = new HashMap<String, Boolean>();
            for (var connector : model.connectors()) {
                for (var end : connector.ends()) {
                    var isFirst = end.equals(connector.ends().getFirst());
                    begin.putIfAbsent(
                            end.toString(),
                            onTheLeft
                                    .map(left -> left.contains(end.component()))
                                    .orElse(isFirst));
                }
            }
            return begin;
        }

        private boolean beginsAtPort(Connector.End end) {
            return requireNonNull(portsThatBegin.get(end.toString()));
        }

        private double widestPriority() {
            return model.priorities().stream()
                    .mapToDouble(each -> 2 * MARGIN_PX + TextMetrics.width(each.toString(), FONT_PX))
                    .max()
                    .orElse(0);
        }

        private AtomType type(String component) {
            return requireNonNull(model.components().get(component));
        }

        private AutomatonSvg automaton(String component) {
            return requireNonNull(automata.get(type(component)));
        }

        private LayoutGraph layoutGraph() {
            var graph =
                    new LayoutGraph(new LayoutGraph.Style(false, false, CycleBreakingStrategy.DEPTH_FIRST, 14, 20, 7));
            for (var component : components) {
                graph.node(size(component), null);
            }
            for (var component : components) {
                for (var port : type(component).ports()) {
                    ports.put(component + "." + port, graph.port(components.indexOf(component), PORT_PX));
                }
            }
            for (var connector : model.connectors()) {
                graph.node(size(connector), null);
                var node = graph.nodes.size() - 1;
                for (var i = 0; i < connector.ends().size(); i++) {
                    var port = requireNonNull(ports.get(connector.ends().get(i).toString()));
                    if (beginsAtPort(connector.ends().get(i))) {
                        graph.edgeFromPort(port, node);
                    } else {
                        graph.edgeToPort(node, port);
                    }
                }
            }
            return graph;
        }

        /** Room for the title and the automaton, beside the names of the ports. */
        private Size size(String component) {
            var type = type(component);
            var automaton = automaton(component).size();
            var title = TextMetrics.width(title(component), FONT_PX);
            return new Size(
                    room(component, true) + Math.max(title, automaton.width()) + room(component, false),
                    TITLE_PX
                            + Math.max(automaton.height(), ROW_PX * type.ports().size())
                            + PADDING_PX);
        }

        /** The width on one side of the automaton: for the names of the ports, if there may be any. */
        private double room(String component, boolean left) {
            if (onTheLeft.isPresent() && onTheLeft.get().contains(component) == left) {
                return PADDING_PX;
            }
            var names = type(component).ports().stream()
                    .mapToDouble(port -> TextMetrics.width(port, SMALL_PX))
                    .max()
                    .orElse(0);
            return names + 2 * PADDING_PX; // the ports are outside of the box
        }

        private String title(String component) {
            return component + ": " + type(component).name();
        }

        private static Size size(Connector connector) {
            return new Size(TextMetrics.width(connector.name(), SMALL_PX) + 10, TextMetrics.lineHeight(SMALL_PX) + 4);
        }

        String write() {
            for (var i = 0; i < components.size(); i++) {
                component(i, components.get(i));
            }
            var edge = 0;
            for (var i = 0; i < model.connectors().size(); i++) {
                var connector = model.connectors().get(i);
                page.group("connector", connector.toString());
                for (var end : connector.ends()) {
                    line(edge++, beginsAtPort(end), end.trigger());
                }
                name(connector, layout.node(components.size() + i));
                page.endGroup();
            }
            priorities();
            return page.end();
        }

        private void component(int number, String component) {
            var corner = layout.node(number);
            var size = size(component);
            page.group("component", title(component));
            page.add(
                    "<rect x=\"%s\" y=\"%s\" width=\"%s\" height=\"%s\" rx=\"6\" fill=\"%s\" fill-opacity=\"0.45\""
                            + " stroke=\"%s\" stroke-width=\"1.3\"/>",
                    corner.x(),
                    corner.y(),
                    size.width(),
                    size.height(),
                    requireNonNull(tints.get(type(component))),
                    Palette.LINE);
            var automaton = automaton(component);
            var middle = corner.x() + (room(component, true) + size.width() - room(component, false)) / 2;
            page.lines(List.of(title(component)), new PixelPoint(middle, corner.y() + TITLE_PX / 2), FONT_PX, "black");
            automaton.write(
                    page,
                    middle - automaton.size().width() / 2,
                    corner.y()
                            + TITLE_PX
                            + (size.height()
                                            - TITLE_PX
                                            - PADDING_PX
                                            - automaton.size().height())
                                    / 2);
            for (var port : type(component).ports()) {
                port(port, layout.port(requireNonNull(ports.get(component + "." + port))), corner, size);
            }
            page.endGroup();
        }

        /** Draws a port, with its name inside of the box. */
        private void port(String port, PixelPoint at, PixelPoint box, Size size) {
            page.add(
                    "<rect class=\"port\" x=\"%s\" y=\"%s\" width=\"%s\" height=\"%s\" fill=\"%s\"/>",
                    at.x(), at.y(), PORT_PX, PORT_PX, Palette.LINE);
            var left = at.x() < box.x() + size.width() / 2;
            page.add(
                    "<text x=\"%s\" y=\"%s\" text-anchor=\"%s\" font-size=\"%s\">%s</text>\n",
                    left ? box.x() + 4 : box.x() + size.width() - 4,
                    at.y() + PORT_PX / 2 + SMALL_PX * 0.35,
                    left ? "start" : "end",
                    SMALL_PX,
                    port);
        }

        private void line(int edge, boolean fromPort, boolean trigger) {
            var route = layout.route(edge);
            page.line(route, Palette.LINE, 1);
            var end = fromPort ? route.getFirst() : route.getLast();
            var next = fromPort ? route.get(1) : route.get(route.size() - 2);
            var direction = Math.signum(next.x() - end.x());
            if (trigger) {
                page.add(
                        "<path class=\"trigger\" d=\"M%s,%s l%s,%s l0,%s z\" fill=\"white\" stroke=\"%s\"/>",
                        end.x(), end.y(), direction * MARK_PX, -MARK_PX / 2, MARK_PX, Palette.LINE);
            } else {
                page.add(
                        "<circle class=\"synchron\" cx=\"%s\" cy=\"%s\" r=\"%s\" fill=\"%s\"/>",
                        end.x() + direction * MARK_PX / 2, end.y(), MARK_PX / 2 - 1, Palette.LINE);
            }
        }

        private void name(Connector connector, PixelPoint corner) {
            var size = size(connector);
            page.add(
                    "<rect x=\"%s\" y=\"%s\" width=\"%s\" height=\"%s\" rx=\"%s\" fill=\"white\" stroke=\"%s\"/>",
                    corner.x(), corner.y(), size.width(), size.height(), size.height() / 2, Palette.FAINT);
            page.lines(
                    List.of(connector.name()),
                    new PixelPoint(corner.x() + size.width() / 2, corner.y() + size.height() / 2),
                    SMALL_PX,
                    "black");
        }

        private void priorities() {
            var y = layout.size().height();
            for (var priority : model.priorities()) {
                page.add("<text class=\"priority\" x=\"%s\" y=\"%s\">%s</text>\n", MARGIN_PX, y, priority);
                y += ROW_PX;
            }
        }
    }

    /** The automaton of a type: circles with the names of places, arrows with the names of ports. */
    private static final class AutomatonSvg {
        private static final double FONT_PX = 12;
        private static final double HEIGHT_PX = 19;
        /** What a layout leaves free on each side; the box around the automaton has its margin, too. */
        private static final double MARGIN_PX = 12;

        /** All steps between two places. */
        private record Arrow(String from, String to, List<String> ports) {
            /** Ports in lines of a few names each. */
            List<String> lines() {
                return TextMetrics.wrapped(
                        ports.stream()
                                .map(port -> ports.indexOf(port) < ports.size() - 1 ? port + "," : port)
                                .toList(),
                        FONT_PX,
                        90);
            }
        }

        private final AtomType type;
        private final List<Arrow> arrows = new ArrayList<>();
        private final Layout layout;

        AutomatonSvg(AtomType type) {
            this.type = type;
            var joined = new LinkedHashMap<List<String>, List<String>>();
            for (var step : type.steps()) {
                joined.computeIfAbsent(List.of(step.from(), step.to()), each -> new ArrayList<>())
                        .add(step.port());
            }
            joined.forEach((ends, ports) -> arrows.add(new Arrow(ends.get(0), ends.get(1), ports)));
            var graph =
                    new LayoutGraph(new LayoutGraph.Style(true, false, CycleBreakingStrategy.BFS_NODE_ORDER, 6, 12, 5));
            type.places().forEach(place -> graph.node(size(place), null));
            for (var arrow : arrows) {
                graph.edge(
                        type.places().indexOf(arrow.from()),
                        type.places().indexOf(arrow.to()),
                        TextMetrics.size(arrow.lines(), FONT_PX));
            }
            layout = Layout.of(graph);
        }

        private static Size size(String place) {
            return new Size(TextMetrics.width(place, FONT_PX) + 8, HEIGHT_PX);
        }

        Size size() {
            return new Size(layout.size().width() - 2 * MARGIN_PX, layout.size().height() - 2 * MARGIN_PX);
        }

        void write(Page page, double x, double y) {
            page.add("<g class=\"automaton\" transform=\"translate(%s %s)\">", x - MARGIN_PX, y - MARGIN_PX);
            for (var i = 0; i < arrows.size(); i++) {
                page.arrow(layout.route(i), Palette.LINE, 0.8, 5);
                @Nullable PixelPoint label = layout.label(i);
                if (label != null) {
                    var lines = arrows.get(i).lines();
                    var size = TextMetrics.size(lines, FONT_PX);
                    page.lines(
                            lines,
                            new PixelPoint(label.x() + size.width() / 2, label.y() + size.height() / 2),
                            FONT_PX,
                            Palette.LINE);
                }
            }
            for (var i = 0; i < type.places().size(); i++) {
                place(page, type.places().get(i), layout.node(i));
            }
            page.endGroup();
        }

        private void place(Page page, String place, PixelPoint corner) {
            var size = size(place);
            page.add(
                    "<rect class=\"place\" x=\"%s\" y=\"%s\" width=\"%s\" height=\"%s\" rx=\"%s\" fill=\"%s\""
                            + " stroke=\"%s\" stroke-width=\"%s\"/>",
                    corner.x(),
                    corner.y(),
                    size.width(),
                    size.height(),
                    size.height() / 2,
                    place.equals(type.initial()) ? Palette.MARKED_FILL : "white",
                    Palette.LINE,
                    place.equals(type.initial()) ? 1.6 : 0.8);
            page.lines(
                    List.of(place),
                    new PixelPoint(corner.x() + size.width() / 2, corner.y() + size.height() / 2),
                    FONT_PX,
                    "black");
        }
    }
}
