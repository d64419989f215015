package io.troupe.demo.svg;

import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

/** SVG elements that several pictures share; coordinates are pixels. */
public final class SvgElements {
    /** Minimum length of the scale bar, which shows 1, 2 or 5 times a power of ten metres. */
    private static final double LEAST_BAR_PX = 48;
    /** Letter width of a sans-serif font, relative to the font size. Generous, since fonts differ. */
    private static final double LETTER = 0.58;

    private static final int CALM_GREEN = 0x2E9F45;

    private SvgElements() {}

    /** The root element on a white background. The title is also read by screen readers. */
    public static String begin(double width, double height, double fontPx, String title) {
        String size = number(width) + " " + number(height);
        return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(width) + "\" height=\"" + number(height)
                + "\" viewBox=\"0 0 " + size + "\" role=\"img\" aria-label=\""
                + escape(title) + "\" font-family=\"sans-serif\" font-size=\"" + number(fontPx) + "\">\n<title>"
                + escape(title) + "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
    }

    /** A line of text; {@code style} holds further attributes. */
    public static String text(double x, double y, String style, String words) {
        return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" " + style + ">" + escape(words) + "</text>\n";
    }

    /** Text with a white outline, so that it is readable on lines. */
    public static String textOnLines(double x, double y, String style, String words) {
        return text(x, y, style + " stroke=\"white\" stroke-width=\"3\" stroke-linejoin=\"round\"", words)
                + text(x, y, style, words);
    }

    /** A scale bar with its left end at {@code x}, and its length in metres as label. */
    public static String scaleBar(double x, double y, double pixelsPerMetre) {
        double metres = roundStep(LEAST_BAR_PX / pixelsPerMetre);
        double end = x + metres * pixelsPerMetre;
        String label = number(metres) + " m";
        return "<g class=\"scale\" stroke=\"#222222\" stroke-width=\"2\">"
                + line(x, y, end, y) + line(x, y - 5, x, y + 5) + line(end, y - 5, end, y + 5) + "</g>"
                + text(end + 8, y + 5, "class=\"scale\" fill=\"#222222\"", label);
    }

    /** Width of {@link #scaleBar} including its label. */
    public static double scaleBarWidth(double pixelsPerMetre, double fontPx) {
        double metres = roundStep(LEAST_BAR_PX / pixelsPerMetre);
        return metres * pixelsPerMetre + 8 + width(number(metres) + " m", fontPx);
    }

    private static String line(double x1, double y1, double x2, double y2) {
        return "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) + "\" y2=\"" + number(y2)
                + "\"/>";
    }

    /** A triangle as arrow head. SVG markers are not supported by all viewers. */
    public static String head(double tipX, double tipY, double directionRad, double lengthPx, String colour) {
        double x = StrictMath.cos(directionRad);
        double y = StrictMath.sin(directionRad);
        double baseX = tipX - lengthPx * x;
        double baseY = tipY - lengthPx * y;
        double half = lengthPx * 0.4;
        return String.format(
                Locale.ROOT,
                "<polygon class=\"head\" points=\"%.1f,%.1f %.1f,%.1f %.1f,%.1f\" fill=\"%s\"/>%n",
                tipX,
                tipY,
                baseX - half * y,
                baseY + half * x,
                baseX + half * y,
                baseY - half * x,
                colour);
    }

    /** The smallest of 1, 2 and 5 times a power of ten that is not below {@code least}. */
    public static double roundStep(double least) {
        double power = StrictMath.pow(10, StrictMath.floor(StrictMath.log10(least)));
        double rest = least / power * (1 - 1e-12);
        return power * (rest <= 1 ? 1 : rest <= 2 ? 2 : rest <= 5 ? 5 : 10);
    }

    /** {@code #rrggbb} of {@code 0x00RRGGBB}. Pure green is darkened, since it is too bright on white. */
    public static String colour(int rgb) {
        return String.format(Locale.ROOT, "#%06x", rgb == 0x00FF00 ? CALM_GREEN : rgb);
    }

    /** A readable text colour on a fill of this colour: black or white. */
    public static String inkOn(int rgb) {
        int shown = rgb == 0x00FF00 ? CALM_GREEN : rgb;
        double light = 0.3 * (shown >> 16 & 0xff) + 0.59 * (shown >> 8 & 0xff) + 0.11 * (shown & 0xff);
        return light > 140 ? "black" : "white";
    }

    /** Upper estimate of the width of a text. */
    public static double width(String words, double fontPx) {
        return words.length() * LETTER * fontPx;
    }

    /** Breaks a text into lines of at most this width. A longer word gets a separate line. */
    public static List<String> wrap(String words, double widthPx, double fontPx) {
        List<String> lines = new ArrayList<>();
        for (String word : words.split(" ")) {
            String longer = lines.isEmpty() ? word : lines.getLast() + " " + word;
            if (!lines.isEmpty() && width(longer, fontPx) <= widthPx) {
                lines.set(lines.size() - 1, longer);
            } else {
                lines.add(word);
            }
        }
        return lines;
    }

    public static String number(double value) {
        return String.format(Locale.ROOT, "%.1f", value).replaceFirst("\\.0$", "");
    }

    public static String escape(String text) {
        return text.replace("&", "&amp;")
                .replace("<", "&lt;")
                .replace(">", "&gt;")
                .replace("\"", "&quot;");
    }
}
