package io.troupe.petri.drawing;

import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

/** Writes an SVG file, element by element. */
final class Svg {
    private static final double CORNER_PX = 5;
    /** Half the width of an arrow's head over its length. */
    private static final double HEAD_SLIMNESS = 0.375;

    /** A cubic curve with its two control points. */
    record Curve(PixelPoint from, PixelPoint first, PixelPoint second, PixelPoint to) {}

    private final StringBuilder text = new StringBuilder();

    Svg(Size size, String title, double fontPx) {
        var width = number(size.width());
        var height = number(size.height());
        text.append("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
        open(
                "svg",
                "xmlns",
                "http://www.w3.org/2000/svg",
                "width",
                width,
                "height",
                height,
                "viewBox",
                "0 0 " + width + " " + height,
                "role",
                "img",
                "aria-label",
                title,
                "font-family",
                TextMetrics.FONTS,
                "font-size",
                fontPx);
        title(title);
        empty("rect", "width", "100%", "height", "100%", "fill", "white");
    }

    /** Starts an element; {@code attributes} alternates names and values. */
    void open(String element, Object... attributes) {
        tag(element, attributes);
        text.append('>');
    }

    void close(String element) {
        text.append("</").append(element).append(">\n");
    }

    void empty(String element, Object... attributes) {
        tag(element, attributes);
        text.append("/>");
    }

    /** Adds the text that viewers show as a tooltip of the enclosing element. */
    void title(String title) {
        open("title");
        text.append(escaped(title));
        close("title");
    }

    /** Writes one line of text. */
    void text(String line, Object... attributes) {
        open("text", attributes);
        text.append(escaped(line));
        close("text");
    }

    /** Writes lines below each other, centred in a box. */
    void lines(List<String> lines, PixelPoint centre, double fontPx, String colour) {
        var lineHeight = TextMetrics.lineHeight(fontPx);
        // the middle of a line is about a third of the font size above its base line
        var y = centre.y() - (lines.size() - 1) * lineHeight / 2 + fontPx * 0.35;
        for (var line : lines) {
            text(line, "x", centre.x(), "y", y, "text-anchor", "middle", "font-size", fontPx, "fill", colour);
            y += lineHeight;
        }
    }

    private void tag(String element, Object... attributes) {
        text.append('<').append(element);
        for (var i = 0; i < attributes.length; i += 2) {
            var value = attributes[i + 1] instanceof Number number ? number(number.doubleValue()) : attributes[i + 1];
            text.append(' ').append(attributes[i]).append("=\"");
            text.append(escaped(String.valueOf(value)).replace("\"", "&quot;")).append('"');
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
        empty("path", "d", data, "fill", "none", "stroke", colour, "stroke-width", widthPx);
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
        empty(
                "path",
                "class",
                "head",
                "d",
                "M" + pair(tip)
                        + " L" + pair(new PixelPoint(base.x() - half * y, base.y() + half * x))
                        + " L" + pair(new PixelPoint(base.x() + half * y, base.y() - half * x)) + " z",
                "fill",
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
        var number = String.format(Locale.ROOT, "%.2f", value);
        return number.replaceFirst("\\.?0+$", "").replaceFirst("^-0$", "0");
    }

    private static String escaped(String value) {
        return value.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;");
    }

    String end() {
        close("svg");
        return text.toString();
    }
}
