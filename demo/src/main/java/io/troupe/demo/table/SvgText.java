package io.troupe.demo.table;

import java.util.Locale;

/** Writes the few elements of SVG that diagrams are made of. */
final class SvgText {
    static final double FONT_PX = 14;
    static final double LINE_PX = 19;
    /** Of a sans-serif font; generous, because fonts differ. */
    private static final double LETTER_PX = 8;

    private final StringBuilder text = new StringBuilder();

    SvgText(double width, double height, String title) {
        add(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%s\" height=\"%s\" viewBox=\"0 0 %s %s\" font-family=\"sans-serif\" font-size=\"%s\">",
                width, height, width, height, FONT_PX);
        add("<title>%s</title>", title);
        text.append(
                        "<defs><marker id=\"arrow\" viewBox=\"0 0 8 6\" refX=\"7.5\" refY=\"3\" markerWidth=\"9\" markerHeight=\"7\"")
                .append(
                        " markerUnits=\"userSpaceOnUse\" orient=\"auto\"><path d=\"M0,0 L8,3 L0,6 z\" fill=\"#444\"/></marker></defs>\n")
                .append("<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n");
    }

    /** How wide a line is. */
    static double width(String line) {
        return line.length() * LETTER_PX;
    }

    void box(double x, double y, double width, double height, String style) {
        add("<rect x=\"%s\" y=\"%s\" width=\"%s\" height=\"%s\" rx=\"8\" " + style + "/>", x, y, width, height);
    }

    void line(String words, double x, double y, String style) {
        add("<text x=\"%s\" y=\"%s\" " + style + ">%s</text>", x, y, words);
    }

    void arrow(String path) {
        add("<path d=\"" + path + "\" fill=\"none\" stroke=\"#444\" stroke-width=\"1.5\" marker-end=\"url(#arrow)\"/>");
    }

    void dot(double x, double y) {
        add("<circle cx=\"%s\" cy=\"%s\" r=\"5\" fill=\"#444\"/>", x, y);
    }

    /** A sample of a colour and a word, on white, in the middle of a line. */
    void label(String words, int colour, double x, double y) {
        double width = width(words) + 18;
        add(
                "<rect x=\"%s\" y=\"%s\" width=\"%s\" height=\"%s\" fill=\"white\"/>",
                x - width / 2 - 3, y - LINE_PX / 2, width + 6, LINE_PX);
        add(
                "<rect x=\"%s\" y=\"%s\" width=\"12\" height=\"12\" fill=\"%s\" stroke=\"#444\"/>",
                x - width / 2, y - 6, String.format(Locale.ROOT, "#%06x", colour));
        line(words, x - width / 2 + 18, y + 5, "");
    }

    String end() {
        return text.append("</svg>\n").toString();
    }

    private void add(String format, Object... values) {
        var safe = new Object[values.length];
        for (int index = 0; index < values.length; index++) {
            safe[index] = values[index] instanceof Double number ? number(number) : escape(values[index].toString());
        }
        text.append(values.length == 0 ? format : String.format(Locale.ROOT, format, safe))
                .append('\n');
    }

    static String number(double value) {
        return String.format(Locale.ROOT, "%.1f", value).replaceFirst("\\.0$", "");
    }

    static String escape(String words) {
        return words.replace("&", "&amp;")
                .replace("<", "&lt;")
                .replace(">", "&gt;")
                .replace("\"", "&quot;");
    }
}
