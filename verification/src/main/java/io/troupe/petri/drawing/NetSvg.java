package io.troupe.petri.drawing;

import io.troupe.petri.Marking;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.Transition;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;

/** Lays out and writes one net. */
final class NetSvg {
    private static final double FONT_PX = 12;
    private static final double SMALL_FONT_PX = 9;
    private static final double RADIUS = 13;
    private static final double BOX_HEIGHT = 22;
    private static final double BOX_WIDTH = 26;
    private static final int MOST_DOTS = 4;
    /** More nodes than this are drawn in rows. */
    private static final int ONE_ROW = 24;

    /** An arc as it is drawn. */
    private record Drawn(Transition transition, Place place, boolean input, int weight) {
        String from() {
            return input ? place.name() : transition.name();
        }

        String to() {
            return input ? transition.name() : place.name();
        }
    }

    private final PetriNet net;
    private final Marking marking;
    private final Set<Transition> highlighted;
    private final List<Drawn> arcs = new ArrayList<>();
    private final Layout layout;
    private final Svg svg;

    NetSvg(PetriNet net, Marking marking, Set<Transition> highlighted) {
        this.net = net;
        this.marking = marking;
        this.highlighted = highlighted;
        for (var transition : net.transitions()) {
            transition.inputs().forEach(arc -> arcs.add(new Drawn(transition, arc.place(), true, arc.weight())));
            transition.outputs().forEach(arc -> arcs.add(new Drawn(transition, arc.place(), false, arc.weight())));
        }
        layout = Layout.of(sketch());
        svg = new Svg(layout.size(), net + " in " + marking, FONT_PX);
    }

    private Sketch sketch() {
        var nodes = net.places().size() + net.transitions().size();
        var wrapped = nodes > ONE_ROW && arcs.stream().allMatch(arc -> arc.weight == 1);
        var sketch = new Sketch(new Sketch.Style(false, wrapped, false, 14, 22, 9));
        for (var place : net.places()) {
            sketch.node(new Size(2 * RADIUS, 2 * RADIUS), Lettering.size(List.of(place.name()), FONT_PX));
        }
        for (var transition : net.transitions()) {
            sketch.node(size(transition), null);
        }
        for (var arc : arcs) {
            var label = arc.weight == 1 ? null : Lettering.size(List.of(String.valueOf(arc.weight)), FONT_PX);
            var place = arc.place.index();
            var transition = number(arc.transition);
            sketch.edge(arc.input ? place : transition, arc.input ? transition : place, label);
        }
        return sketch;
    }

    private int number(Transition transition) {
        return net.places().size() + transition.index();
    }

    private static Size size(Transition transition) {
        var name = Lettering.width(transition.name(), FONT_PX);
        var more = Lettering.width(priority(transition), SMALL_FONT_PX);
        var height = BOX_HEIGHT + (transition.priority() == 0 ? 0 : Lettering.lineHeight(SMALL_FONT_PX));
        return new Size(Math.max(BOX_WIDTH, Math.max(name, more) + 8), height);
    }

    private static String priority(Transition transition) {
        return transition.priority() == 0 ? "" : "priority " + transition.priority();
    }

    String write() {
        // coloured arcs last, so that they lie on top
        for (var coloured : List.of(false, true)) {
            for (var i = 0; i < arcs.size(); i++) {
                if (highlighted.contains(arcs.get(i).transition) == coloured) {
                    arc(i, coloured);
                }
            }
        }
        net.places().forEach(this::place);
        net.transitions().forEach(this::transition);
        return svg.end();
    }

    private void arc(int number, boolean coloured) {
        var arc = arcs.get(number);
        svg.open("g", "class", coloured ? "arc path" : "arc");
        svg.title(arc.from() + " → " + arc.to() + (arc.weight == 1 ? "" : ", weight " + arc.weight));
        var route = new ArrayList<>(layout.route(number));
        var corner = layout.node(arc.place.index());
        var centre = new Point(corner.x() + RADIUS, corner.y() + RADIUS);
        var end = arc.input ? 0 : route.size() - 1;
        route.set(end, ontoCircle(route.get(end), route.get(arc.input ? 1 : end - 1), centre));
        svg.empty(
                "path",
                "d",
                Svg.along(route),
                "fill",
                "none",
                "stroke",
                coloured ? Colours.PATH : Colours.LINE,
                "stroke-width",
                coloured ? 2 : 1,
                "marker-end",
                coloured ? "url(#arrow-path)" : "url(#arrow)");
        var label = layout.label(number);
        if (label != null) {
            weight(arc.weight, label, coloured);
        }
        svg.close("g");
    }

    private void weight(int weight, Point corner, boolean coloured) {
        var text = List.of(String.valueOf(weight));
        var size = Lettering.size(text, FONT_PX);
        svg.lines(
                text,
                new Point(corner.x() + size.width() / 2, corner.y() + size.height() / 2),
                FONT_PX,
                coloured ? Colours.PATH : Colours.LINE);
    }

    /** The layout ends an arc at the square around the circle: it goes on, in the direction it has, until it meets the circle. */
    private static Point ontoCircle(Point end, Point before, Point centre) {
        if (before.y() == end.y()) {
            var dy = end.y() - centre.y();
            var dx = Math.sqrt(Math.max(0, RADIUS * RADIUS - dy * dy));
            return new Point(centre.x() + Math.copySign(dx, end.x() - centre.x()), end.y());
        }
        var dx = end.x() - centre.x();
        var dy = Math.sqrt(Math.max(0, RADIUS * RADIUS - dx * dx));
        return new Point(end.x(), centre.y() + Math.copySign(dy, end.y() - centre.y()));
    }

    private void place(Place place) {
        var tokens = marking.tokens(place);
        var corner = layout.node(place.index());
        var centre = new Point(corner.x() + RADIUS, corner.y() + RADIUS);
        svg.open("g", "class", "place");
        svg.title(place.name() + ": " + tokens + (tokens == 1 ? " token" : " tokens"));
        svg.empty(
                "circle",
                "cx",
                centre.x(),
                "cy",
                centre.y(),
                "r",
                RADIUS,
                "fill",
                tokens > 0 ? Colours.MARKED_FILL : "white",
                "stroke",
                Colours.LINE,
                "stroke-width",
                1.3);
        tokens(tokens, centre);
        var below = new Point(centre.x(), centre.y() + RADIUS + 2 + Lettering.lineHeight(FONT_PX) / 2);
        svg.lines(List.of(place.name()), below, FONT_PX, "black");
        svg.close("g");
    }

    private void tokens(int tokens, Point centre) {
        if (tokens > MOST_DOTS) {
            svg.lines(List.of(String.valueOf(tokens)), centre, tokens < 1000 ? FONT_PX : 6, "black");
            return;
        }
        var distance = tokens == 1 ? 0 : RADIUS * 0.45;
        for (var i = 0; i < tokens; i++) {
            var angle = Math.PI * (2 * i + 1) / Math.max(1, tokens) + (tokens == 2 ? Math.PI / 2 : 0);
            svg.empty(
                    "circle",
                    "cx",
                    centre.x() + distance * Math.sin(angle),
                    "cy",
                    centre.y() + distance * Math.cos(angle),
                    "r",
                    tokens == 1 ? 4 : 3,
                    "fill",
                    "black");
        }
    }

    private void transition(Transition transition) {
        var coloured = highlighted.contains(transition);
        var corner = layout.node(number(transition));
        var size = size(transition);
        svg.open("g", "class", coloured ? "transition path" : "transition");
        svg.title(transition.name());
        svg.empty(
                "rect",
                "x",
                corner.x(),
                "y",
                corner.y(),
                "width",
                size.width(),
                "height",
                size.height(),
                "fill",
                coloured ? Colours.PATH_FILL : "#eeeeee",
                "stroke",
                coloured ? Colours.PATH : Colours.LINE,
                "stroke-width",
                coloured ? 2 : 1.3);
        var middle = corner.x() + size.width() / 2;
        svg.lines(List.of(transition.name()), new Point(middle, corner.y() + BOX_HEIGHT / 2), FONT_PX, "black");
        if (transition.priority() != 0) {
            var below = new Point(middle, corner.y() + size.height() - Lettering.lineHeight(SMALL_FONT_PX) / 2 - 2);
            svg.lines(List.of(priority(transition)), below, SMALL_FONT_PX, Colours.LINE);
        }
        svg.close("g");
    }
}
