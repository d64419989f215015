package io.troupe.petri.drawing;

import io.troupe.petri.Place;
import io.troupe.petri.Transition;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;

/** Writes the arcs of a net. */
final class NetArcs {
    /** An arc to draw. */
    record Drawn(Transition transition, Place place, boolean input, int weight) {
        String from() {
            return input ? place.name() : transition.name();
        }

        String to() {
            return input ? transition.name() : place.name();
        }
    }

    private final Svg svg;
    private final Layout layout;
    private final Set<Transition> highlighted;

    NetArcs(Svg svg, Layout layout, Set<Transition> highlighted) {
        this.svg = svg;
        this.layout = layout;
        this.highlighted = highlighted;
    }

    /** Writes the arcs, which are in the order of the layout's edges. */
    void write(List<Drawn> arcs) {
        // coloured arcs last, so that they lie on top
        for (var coloured : List.of(false, true)) {
            for (var i = 0; i < arcs.size(); i++) {
                if (highlighted.contains(arcs.get(i).transition()) == coloured) {
                    arc(i, arcs.get(i), coloured);
                }
            }
        }
    }

    private void arc(int number, Drawn arc, boolean coloured) {
        svg.open("g", "class", coloured ? "arc path" : "arc");
        svg.title(arc.from() + " → " + arc.to() + (arc.weight == 1 ? "" : ", weight " + arc.weight));
        var route = new ArrayList<>(layout.route(number));
        var corner = layout.node(arc.place.index());
        var centre = new PixelPoint(corner.x() + NetSvg.RADIUS, corner.y() + NetSvg.RADIUS);
        var end = arc.input ? 0 : route.size() - 1;
        route.set(end, ontoCircle(route.get(end), route.get(arc.input ? 1 : end - 1), centre));
        svg.arrow(route, coloured ? Palette.PATH : Palette.LINE, coloured ? 2 : 1, 8);
        var label = layout.label(number);
        if (label != null) {
            weight(arc.weight, label, coloured);
        }
        svg.close("g");
    }

    private void weight(int weight, PixelPoint corner, boolean coloured) {
        var text = List.of(String.valueOf(weight));
        var size = TextMetrics.size(text, NetSvg.FONT_PX);
        svg.lines(
                text,
                new PixelPoint(corner.x() + size.width() / 2, corner.y() + size.height() / 2),
                NetSvg.FONT_PX,
                coloured ? Palette.PATH : Palette.LINE);
    }

    /** Extends the end of an arc to the circle: the layout ends it at the square around the circle. */
    private static PixelPoint ontoCircle(PixelPoint end, PixelPoint before, PixelPoint centre) {
        if (before.y() == end.y()) {
            var dy = end.y() - centre.y();
            var dx = Math.sqrt(Math.max(0, NetSvg.RADIUS * NetSvg.RADIUS - dy * dy));
            return new PixelPoint(centre.x() + Math.copySign(dx, end.x() - centre.x()), end.y());
        }
        var dx = end.x() - centre.x();
        var dy = Math.sqrt(Math.max(0, NetSvg.RADIUS * NetSvg.RADIUS - dx * dx));
        return new PixelPoint(end.x(), centre.y() + Math.copySign(dy, end.y() - centre.y()));
    }
}
