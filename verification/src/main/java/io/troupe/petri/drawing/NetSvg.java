package io.troupe.petri.drawing;

import io.troupe.petri.Arc;
import io.troupe.petri.Marking;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.Transition;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Stream;
import org.eclipse.elk.alg.layered.options.CycleBreakingStrategy;

/** Lays out and writes one net. */
final class NetSvg {
    static final double FONT_PX = 12;
    private static final double INHIBITOR_RADIUS = 3.5;
    private static final double SMALL_FONT_PX = 9;
    static final double RADIUS = 13;
    private static final double BOX_HEIGHT = 22;
    private static final double BOX_WIDTH = 26;
    private static final double MARGIN_PX = 12;
    private static final double LEGEND_PX = 30;
    private static final double SAMPLE_PX = 14;
    private static final int MOST_DOTS = 4;
    /** The most nodes of a net that is drawn as one long chain, which is the clearest layout for small nets. */
    private static final int FEW_NODES = 24;
    /** Width over height of a net that is wider than a page, unless it is drawn in rows. */
    private static final double MOST_SHAPE = 1.5;
    /** A wider picture, scaled to 830 px, has letters below 9 px. */
    private static final double WIDE_PX = 1100;

    private final PetriNet net;
    private final Marking marking;
    private final Set<Transition> highlighted;
    private final List<String> components;
    private final Map<Place, String> tints = new HashMap<>();
    private final List<ArcWriter.DrawnArc> arcs = new ArrayList<>();
    private final Layout layout;
    private final Page page;

    NetSvg(PetriNet net, Marking marking, Set<Transition> highlighted, Map<String, List<Place>> components) {
        this.net = net;
        this.marking = marking;
        this.highlighted = highlighted;
        this.components = List.copyOf(components.keySet());
        for (var i = 0; i < this.components.size(); i++) {
            var tint = Palette.TINTS.get(i % Palette.TINTS.size());
            components.get(this.components.get(i)).forEach(place -> tints.put(place, tint));
        }
        for (var transition : net.transitions()) {
            transition.inputs().forEach(arc -> arcs.add(ArcWriter.DrawnArc.input(transition, arc)));
            transition.outputs().forEach(arc -> arcs.add(ArcWriter.DrawnArc.output(transition, arc)));
            transition.inhibitors().forEach(arc -> arcs.add(ArcWriter.DrawnArc.inhibitor(transition, arc)));
        }
        layout = layout();
        var legend = this.components.isEmpty() ? 0 : LEGEND_PX;
        var size = new Size(
                Math.max(layout.size().width(), legendX(this.components.size())),
                layout.size().height() + legend);
        page = new Page(size, net + " in " + marking, FONT_PX);
    }

    /** Lays out a small net as one chain, and a large one breadth first or, if that is too wide, in rows. */
    private Layout layout() {
        if (net.places().size() + net.transitions().size() <= FEW_NODES) {
            return Layout.of(layoutGraph(false, CycleBreakingStrategy.DEPTH_FIRST));
        }
        var compact = Layout.of(layoutGraph(false, CycleBreakingStrategy.BFS_NODE_ORDER));
        var canWrap = arcs.stream().allMatch(arc -> arc.weight() == 1);
        return canWrap
                        && compact.size().width()
                                > Math.max(WIDE_PX, MOST_SHAPE * compact.size().height())
                ? Layout.of(layoutGraph(true, CycleBreakingStrategy.DEPTH_FIRST))
                : compact;
    }

    private LayoutGraph layoutGraph(boolean wrapped, CycleBreakingStrategy order) {
        var layoutGraph = new LayoutGraph(new LayoutGraph.Style(false, wrapped, order, 14, 22, 9));
        for (var place : net.places()) {
            layoutGraph.node(new Size(2 * RADIUS, 2 * RADIUS), TextMetrics.size(List.of(place.name()), FONT_PX));
        }
        for (var transition : net.transitions()) {
            layoutGraph.node(size(transition), null);
        }
        for (var arc : arcs) {
            var label = arc.weight() == 1 ? null : TextMetrics.size(List.of(String.valueOf(arc.weight())), FONT_PX);
            var place = arc.place().index();
            var transition = number(arc.transition());
            layoutGraph.edge(arc.input() ? place : transition, arc.input() ? transition : place, label);
        }
        return layoutGraph;
    }

    private int number(Transition transition) {
        return net.places().size() + transition.index();
    }

    private static Size size(Transition transition) {
        var name = TextMetrics.width(transition.name(), FONT_PX);
        var more = TextMetrics.width(priority(transition), SMALL_FONT_PX);
        var height = BOX_HEIGHT + (transition.priority() == 0 ? 0 : TextMetrics.lineHeight(SMALL_FONT_PX));
        return new Size(Math.max(BOX_WIDTH, Math.max(name, more) + 8), height);
    }

    private static String priority(Transition transition) {
        return transition.priority() == 0 ? "" : "priority " + transition.priority();
    }

    String write() {
        new ArcWriter(page, layout, highlighted).write(arcs);
        net.places().forEach(this::place);
        net.transitions().forEach(this::transition);
        legend();
        return page.end();
    }

    /** Draws a sample of each fill below the net. */
    private void legend() {
        var middle = layout.size().height() + LEGEND_PX / 2 - MARGIN_PX / 2;
        for (var i = 0; i < components.size(); i++) {
            var x = legendX(i);
            page.add(
                    "<rect class=\"tint\" x=\"%s\" y=\"%s\" width=\"%s\" height=\"%s\" fill=\"%s\" stroke=\"%s\"/>",
                    x,
                    middle - SAMPLE_PX / 2,
                    SAMPLE_PX,
                    SAMPLE_PX,
                    Palette.TINTS.get(i % Palette.TINTS.size()),
                    Palette.LINE);
            page.add(
                    "<text x=\"%s\" y=\"%s\">%s</text>\n",
                    x + SAMPLE_PX + 6, middle + FONT_PX * 0.35, components.get(i));
        }
    }

    private double legendX(int number) {
        return MARGIN_PX
                + components.stream()
                        .limit(number)
                        .mapToDouble(component -> SAMPLE_PX + 6 + TextMetrics.width(component, FONT_PX) + 18)
                        .sum();
    }

    private String fill(Place place, long tokens) {
        return tints.getOrDefault(place, tokens > 0 ? Palette.MARKED_FILL : "white");
    }

    /** The fill that all places around a transition share, or grey. */
    private String fill(Transition transition) {
        if (highlighted.contains(transition)) {
            return Palette.PATH_FILL;
        }
        var around = Stream.concat(transition.inputs().stream(), transition.outputs().stream())
                .map(arc -> tints.getOrDefault(arc.place(), Palette.BETWEEN_FILL))
                .distinct()
                .toList();
        return around.size() == 1 ? around.getFirst() : Palette.BETWEEN_FILL;
    }

    private void place(Place place) {
        var tokens = marking.tokens(place);
        var corner = layout.node(place.index());
        var centre = new PixelPoint(corner.x() + RADIUS, corner.y() + RADIUS);
        page.group("place", place.name() + ": " + tokens + (tokens == 1 ? " token" : " tokens"));
        page.add(
                "<circle cx=\"%s\" cy=\"%s\" r=\"%s\" fill=\"%s\" stroke=\"%s\" stroke-width=\"%s\"/>",
                centre.x(),
                centre.y(),
                RADIUS,
                fill(place, tokens),
                Palette.LINE,
                tokens > 0 && tints.containsKey(place) ? 2.4 : 1.3);
        tokens(tokens, centre);
        var below = new PixelPoint(centre.x(), centre.y() + RADIUS + 2 + TextMetrics.lineHeight(FONT_PX) / 2);
        page.lines(List.of(place.name()), below, FONT_PX, "black");
        page.endGroup();
    }

    private void tokens(long tokens, PixelPoint centre) {
        if (tokens > MOST_DOTS) {
            page.lines(List.of(String.valueOf(tokens)), centre, tokens < 1000 ? FONT_PX : 6, "black");
            return;
        }
        var distance = tokens == 1 ? 0 : RADIUS * 0.45;
        for (var i = 0; i < tokens; i++) {
            var angle = Math.PI * (2 * i + 1) / Math.max(1, tokens) + (tokens == 2 ? Math.PI / 2 : 0);
            page.add(
                    "<circle cx=\"%s\" cy=\"%s\" r=\"%s\" fill=\"black\"/>",
                    centre.x() + distance * Math.sin(angle),
                    centre.y() + distance * Math.cos(angle),
                    tokens == 1 ? 4 : 3);
        }
    }

    private void transition(Transition transition) {
        var coloured = highlighted.contains(transition);
        var corner = layout.node(number(transition));
        var size = size(transition);
        page.group(coloured ? "transition path" : "transition", transition.name());
        page.add(
                "<rect x=\"%s\" y=\"%s\" width=\"%s\" height=\"%s\" fill=\"%s\" stroke=\"%s\" stroke-width=\"%s\"/>",
                corner.x(),
                corner.y(),
                size.width(),
                size.height(),
                fill(transition),
                coloured ? Palette.PATH : Palette.LINE,
                coloured ? 2 : 1.3);
        var middle = corner.x() + size.width() / 2;
        page.lines(List.of(transition.name()), new PixelPoint(middle, corner.y() + BOX_HEIGHT / 2), FONT_PX, "black");
        if (transition.priority() != 0) {
            var below =
                    new PixelPoint(middle, corner.y() + size.height() - TextMetrics.lineHeight(SMALL_FONT_PX) / 2 - 2);
            page.lines(List.of(priority(transition)), below, SMALL_FONT_PX, Palette.LINE);
        }
        page.endGroup();
    }

    /** Writes the arcs of a net. */
    private static final class ArcWriter {
        /** An arc to draw. */
        record DrawnArc(Transition transition, Place place, boolean input, boolean inhibits, int weight) {
            static DrawnArc input(Transition transition, Arc arc) {
                return new DrawnArc(transition, arc.place(), true, false, arc.weight());
            }

            static DrawnArc output(Transition transition, Arc arc) {
                return new DrawnArc(transition, arc.place(), false, false, arc.weight());
            }

            static DrawnArc inhibitor(Transition transition, Arc arc) {
                return new DrawnArc(transition, arc.place(), true, true, arc.weight());
            }

            String from() {
                return input ? place.name() : transition.name();
            }

            String to() {
                return input ? transition.name() : place.name();
            }
        }

        private final Page page;
        private final Layout layout;
        private final Set<Transition> highlighted;

        ArcWriter(Page page, Layout layout, Set<Transition> highlighted) {
            this.page = page;
            this.layout = layout;
            this.highlighted = highlighted;
        }

        /** Writes the arcs, which are in the order of the layout's edges. */
        void write(List<DrawnArc> arcs) {
            // coloured arcs last, so that they lie on top
            for (var coloured : List.of(false, true)) {
                for (var i = 0; i < arcs.size(); i++) {
                    if (highlighted.contains(arcs.get(i).transition()) == coloured) {
                        arc(i, arcs.get(i), coloured);
                    }
                }
            }
        }

        private void arc(int number, DrawnArc arc, boolean coloured) {
            page.group(
                    (arc.inhibits ? "inhibitor " : "") + (coloured ? "arc path" : "arc"),
                    arc.from()
                            + (arc.inhibits ? " inhibits " : " → ")
                            + arc.to()
                            + (arc.weight == 1 ? "" : ", weight " + arc.weight));
            var route = new ArrayList<>(layout.route(number));
            var corner = layout.node(arc.place.index());
            var centre = new PixelPoint(corner.x() + RADIUS, corner.y() + RADIUS);
            var end = arc.input ? 0 : route.size() - 1;
            route.set(end, ontoCircle(route.get(end), route.get(arc.input ? 1 : end - 1), centre));
            var colour = coloured ? Palette.PATH : Palette.LINE;
            if (arc.inhibits) {
                page.inhibitor(route, colour, coloured ? 2 : 1, INHIBITOR_RADIUS);
            } else {
                page.arrow(route, colour, coloured ? 2 : 1, 8);
            }
            var label = layout.label(number);
            if (label != null) {
                weight(arc.weight, label, coloured);
            }
            page.endGroup();
        }

        private void weight(int weight, PixelPoint corner, boolean coloured) {
            var text = List.of(String.valueOf(weight));
            var size = TextMetrics.size(text, FONT_PX);
            page.lines(
                    text,
                    new PixelPoint(corner.x() + size.width() / 2, corner.y() + size.height() / 2),
                    FONT_PX,
                    coloured ? Palette.PATH : Palette.LINE);
        }

        /** Extends the end of an arc to the circle: the layout ends it at the square around the circle. */
        private static PixelPoint ontoCircle(PixelPoint end, PixelPoint before, PixelPoint centre) {
            if (before.y() == end.y()) {
                var dy = end.y() - centre.y();
                var dx = Math.sqrt(Math.max(0, RADIUS * RADIUS - dy * dy));
                return new PixelPoint(centre.x() + Math.copySign(dx, end.x() - centre.x()), end.y());
            }
            var dx = end.x() - centre.x();
            var dy = Math.sqrt(Math.max(0, RADIUS * RADIUS - dx * dx));
            return new PixelPoint(end.x(), centre.y() + Math.copySign(dy, end.y() - centre.y()));
        }
    }
}
