package io.troupe.petri.drawing;

import io.troupe.drawing.Svg;
import java.util.ArrayList;
import java.util.List;

/** A page with labels and arrows between nodes. */
final class Page {
    private static final double CORNER_PX = 5;
    /** Half the width of an arrow's head over its length. */
    private static final double HEAD_SLIMNESS = 0.375;

    /** A cubic curve with its two control points. */
    record Curve(PixelPoint from, PixelPoint first, PixelPoint second, PixelPoint to) {}

    private final Svg svg;

    Page(Size size, String title, double fontPx) {
        svg = Svg.document(size.width(), size.height(), TextMetrics.FONTS, fontPx, title);
    }

    /** Adds markup as {@link Svg#add} does. */
    void add(String markup, Object... values) {
        svg.add(markup, values);
    }

    /** Starts a group of elements, with a title that viewers show as a tooltip. */
    void group(String classes, String title) {
        svg.add("<g class=\"%s\"><title>%s</title>\n", classes, title);
    }

    void endGroup() {
        svg.add("</g>\n");
    }

    /** Writes lines below each other, centred in a box. */
    void lines(List<String> lines, PixelPoint centre, double fontPx, String colour) {
        var lineHeight = TextMetrics.lineHeight(fontPx);
        // the middle of a line is about a third of the font size above its base line
        var y = centre.y() - (lines.size() - 1) * lineHeight / 2 + fontPx * 0.35;
        for (var line : lines) {
            svg.add(
                    "<text x=\"%s\" y=\"%s\" text-anchor=\"middle\" font-size=\"%s\" fill=\"%s\">%s</text>\n",
                    centre.x(), y, fontPx, colour, line);
            y += lineHeight;
        }
    }

    /** Draws an arrow along {@code route}, with rounded corners. */
    void arrow(List<PixelPoint> route, String colour, double widthPx, double headPx) {
        var end = route.size() - 1;
        var shortened = new ArrayList<>(route);
        shortened.set(end, nearer(route.get(end), route.get(end - 1), headPx));
        line(along(shortened), colour, widthPx);
        head(route.get(end - 1), route.get(end), colour, headPx);
    }

    /** Draws a line along {@code route} that ends in a small circle, the sign of an inhibitor arc. */
    void inhibitor(List<PixelPoint> route, String colour, double widthPx, double radiusPx) {
        var end = route.size() - 1;
        var centre = nearer(route.get(end), route.get(end - 1), 2 * radiusPx);
        var shortened = new ArrayList<>(route);
        shortened.set(end, nearer(route.get(end), route.get(end - 1), 4 * radiusPx));
        line(along(shortened), colour, widthPx);
        svg.add(
                "<circle class=\"head\" cx=\"%s\" cy=\"%s\" r=\"%s\" fill=\"white\" stroke=\"%s\" stroke-width=\"%s\"/>",
                centre.x(), centre.y(), radiusPx, colour, widthPx);
    }

    /** Draws a line along {@code route}, with rounded corners. */
    void line(List<PixelPoint> route, String colour, double widthPx) {
        line(along(route), colour, widthPx);
    }

    /** Draws an arrow along a cubic curve. */
    void arrow(Curve curve, String colour, double widthPx, double headPx) {
        var shortened = nearer(curve.to, curve.second, headPx);
        line(
                "M" + pair(curve.from) + " C" + pair(curve.first) + " " + pair(curve.second) + " " + pair(shortened),
                colour,
                widthPx);
        head(curve.second, curve.to, colour, headPx);
    }

    private void line(String data, String colour, double widthPx) {
        svg.add("<path d=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"%s\"/>", data, colour, widthPx);
    }

    /** Draws an arrow head as a plain triangle: not all renderers draw SVG's markers, and some rotate them wrongly. */
    private void head(PixelPoint before, PixelPoint tip, String colour, double lengthPx) {
        var dx = tip.x() - before.x();
        var dy = tip.y() - before.y();
        var length = Math.hypot(dx, dy);
        var x = length == 0 ? 1 : dx / length;
        var y = length == 0 ? 0 : dy / length;
        var base = new PixelPoint(tip.x() - lengthPx * x, tip.y() - lengthPx * y);
        var half = lengthPx * HEAD_SLIMNESS;
        svg.add(
                "<path class=\"head\" d=\"M%s L%s L%s z\" fill=\"%s\"/>",
                pair(tip),
                pair(new PixelPoint(base.x() - half * y, base.y() + half * x)),
                pair(new PixelPoint(base.x() + half * y, base.y() - half * x)),
                colour);
    }

    /** The end of the line under an arrow head, short of the tip so that it does not show there. */
    private static PixelPoint nearer(PixelPoint tip, PixelPoint before, double headPx) {
        var length = Math.hypot(tip.x() - before.x(), tip.y() - before.y());
        var part = length == 0 ? 0 : Math.min(1, headPx / 2 / length);
        return new PixelPoint(tip.x() + (before.x() - tip.x()) * part, tip.y() + (before.y() - tip.y()) * part);
    }

    /** The data of a path along {@code route} with rounded corners. */
    private static String along(List<PixelPoint> route) {
        var data = new StringBuilder("M").append(pair(route.getFirst()));
        for (var i = 1; i < route.size() - 1; i++) {
            var corner = route.get(i);
            data.append(" L").append(pair(towards(corner, route.get(i - 1))));
            data.append(" Q").append(pair(corner));
            data.append(' ').append(pair(towards(corner, route.get(i + 1))));
        }
        return data.append(" L").append(pair(route.getLast())).toString();
    }

    /** A point near the corner, at most half of the way, so that two rounded corners do not overlap. */
    private static PixelPoint towards(PixelPoint corner, PixelPoint other) {
        var dx = other.x() - corner.x();
        var dy = other.y() - corner.y();
        var length = Math.hypot(dx, dy);
        var part = length == 0 ? 0 : Math.min(CORNER_PX, length / 2) / length;
        return new PixelPoint(corner.x() + dx * part, corner.y() + dy * part);
    }

    private static String pair(PixelPoint point) {
        return number(point.x()) + "," + number(point.y());
    }

    private static String number(double value) {
        return Svg.number(value, 2);
    }

    /** Ends the page, and returns the SVG file. */
    String end() {
        return svg.end();
    }
}
