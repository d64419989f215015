package io.troupe.demo.table;

import io.troupe.demo.svg.SvgElements;
import java.util.Locale;

/** Writes the SVG elements of diagrams. */
final class SvgText {
    static final double FONT_PX = 14;
    static final double LINE_PX = 19;
    private static final double HEAD_PX = 9;
    /** Letter width of a sans-serif font. Generous, since fonts differ. */
    private static final double LETTER_PX = 8;

    record Point(double x, double y) {}

    private final StringBuilder text = new StringBuilder();

    SvgText(double width, double height, String title) {
        text.append(SvgElements.begin(width, height, FONT_PX, title));
    }

    /** Upper estimate of the width of a line. */
    static double width(String line) {
        return line.length() * LETTER_PX;
    }

    void box(double x, double y, double width, double height, String style) {
        add("<rect x=\"%s\" y=\"%s\" width=\"%s\" height=\"%s\" rx=\"8\" " + style + "/>", x, y, width, height);
    }

    void line(String words, double x, double y, String style) {
        add("<text x=\"%s\" y=\"%s\" " + style + ">%s</text>", x, y, words);
    }

    /** An arrow: SVG path data, continued to {@code tip}, which is approached from {@code before}. */
    void arrow(String start, Point before, Point tip) {
        double direction = StrictMath.atan2(tip.y() - before.y(), tip.x() - before.x());
        var end = new Point(
                tip.x() - HEAD_PX / 2 * StrictMath.cos(direction), tip.y() - HEAD_PX / 2 * StrictMath.sin(direction));
        add("<path class=\"arrow\" d=\"" + start + number(end.x()) + "," + number(end.y())
                + "\" fill=\"none\" stroke=\"#444\" stroke-width=\"1.5\"/>");
        text.append(SvgElements.head(tip.x(), tip.y(), direction, HEAD_PX, "#444"));
    }

    void dot(double x, double y) {
        add("<circle cx=\"%s\" cy=\"%s\" r=\"5\" fill=\"#444\"/>", x, y);
    }

    /** A coloured square and a label on white, centred on a line. */
    void label(String words, int colour, double x, double y) {
        double width = width(words) + 18;
        add(
                "<rect x=\"%s\" y=\"%s\" width=\"%s\" height=\"%s\" fill=\"white\"/>",
                x - width / 2 - 3, y - LINE_PX / 2, width + 6, LINE_PX);
        add(
                "<rect x=\"%s\" y=\"%s\" width=\"12\" height=\"12\" fill=\"%s\" stroke=\"#444\"/>",
                x - width / 2, y - 6, SvgElements.colour(colour));
        line(words, x - width / 2 + 18, y + 5, "");
    }

    String end() {
        return text.append("</svg>\n").toString();
    }

    private void add(String format, Object... values) {
        var safe = new Object[values.length];
        for (int index = 0; index < values.length; index++) {
            safe[index] = values[index] instanceof Double number
                    ? number(number)
                    : SvgElements.escape(values[index].toString());
        }
        text.append(values.length == 0 ? format : String.format(Locale.ROOT, format, safe))
                .append('\n');
    }

    static String number(double value) {
        return String.format(Locale.ROOT, "%.1f", value).replaceFirst("\\.0$", "");
    }
}
