package io.troupe.petri.drawing;

import java.util.List;
import java.util.Locale;

/** Writes an SVG file, element by element. */
final class Svg {
    private static final double CORNER_PX = 5;

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
                "font-family",
                Lettering.FONTS,
                "font-size",
                fontPx);
        title(title);
        text.append("<defs>");
        arrowHead("arrow", Colours.LINE, 8);
        arrowHead("arrow-faint", Colours.FAINT, 4);
        arrowHead("arrow-back", Colours.BACK, 4);
        arrowHead("arrow-path", Colours.PATH, 8);
        text.append("</defs>\n");
        empty("rect", "width", "100%", "height", "100%", "fill", "white");
    }

    private void arrowHead(String id, String colour, double lengthPx) {
        open(
                "marker",
                "id",
                id,
                "viewBox",
                "0 0 8 6",
                "refX",
                7.5,
                "refY",
                3,
                "markerWidth",
                lengthPx,
                "markerHeight",
                lengthPx * 0.75,
                "markerUnits",
                "userSpaceOnUse",
                "orient",
                "auto");
        empty("path", "d", "M0,0 L8,3 L0,6 z", "fill", colour);
        close("marker");
    }

    /** Starts an element; attributes are names and values in turn. */
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

    /** What viewers show when the pointer rests on the element around it. */
    void title(String title) {
        open("title");
        text.append(escaped(title));
        close("title");
    }

    /** One line of text. */
    void text(String line, Object... attributes) {
        open("text", attributes);
        text.append(escaped(line));
        close("text");
    }

    /** Lines one below the other, centred in a box. */
    void lines(List<String> lines, Point centre, double fontPx, String colour) {
        var lineHeight = Lettering.lineHeight(fontPx);
        // the middle of a line is about a third of the font's size above its base line
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

    /** The data of a path along {@code route} with rounded corners. */
    static String along(List<Point> route) {
        var data = new StringBuilder("M").append(pair(route.getFirst()));
        for (var i = 1; i < route.size() - 1; i++) {
            var corner = route.get(i);
            data.append(" L").append(pair(towards(corner, route.get(i - 1))));
            data.append(" Q").append(pair(corner));
            data.append(' ').append(pair(towards(corner, route.get(i + 1))));
        }
        return data.append(" L").append(pair(route.getLast())).toString();
    }

    /** The data of a cubic curve. */
    static String curve(Point from, Point first, Point second, Point to) {
        return "M" + pair(from) + " C" + pair(first) + " " + pair(second) + " " + pair(to);
    }

    /** A point a little from the corner, at most half of the way, so that two corners do not meet. */
    private static Point towards(Point corner, Point other) {
        var dx = other.x() - corner.x();
        var dy = other.y() - corner.y();
        var length = Math.hypot(dx, dy);
        var part = length == 0 ? 0 : Math.min(CORNER_PX, length / 2) / length;
        return new Point(corner.x() + dx * part, corner.y() + dy * part);
    }

    private static String pair(Point point) {
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
