package io.troupe.drawing;

import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/**
 * Writes an SVG picture, element by element.
 *
 * <p><b>Role.</b> The caller writes markup with places for values. Texts are escaped and numbers are rounded here, so
 * that no value can break the markup.
 *
 * {@snippet :
 * var svg = Svg.page(200, 100, 14, "A lamp");
 * svg.add("<circle cx=\"%s\" cy=\"%s\" r=\"8\" fill=\"%s\"/>\n", 30.0, 50.0, Svg.colour(0xFF0000));
 * svg.text(44, 55, "font-weight=\"bold\"", "on & red");
 * Files.writeString(file, svg.end());
 * }
 *
 * <p><b>Threads.</b> For one thread at a time.
 *
 * <p><b>Order.</b> The same calls give the same bytes on every machine.
 *
 * <p><b>Units and shapes.</b> Pixels, y downwards; angles in radians, clockwise. Colours are {@code 0x00RRGGBB}.
 */
public final class Svg {
    /** Letter width of a sans-serif font, relative to the font size. Generous, since fonts differ. */
    private static final double LETTER = 0.58;
    /** Half the width of an arrow head, relative to its length. */
    private static final double HEAD_SLIMNESS = 0.4;

    private static final int PURE_GREEN = 0x00FF00;
    private static final int CALM_GREEN = 0x2E9F45;

    private static final Pattern PLACE = Pattern.compile("%(?:s|d|\\.\\df)");

    private final StringBuilder text = new StringBuilder();
    private final int decimals;

    private Svg(int decimals) {
        this.decimals = decimals;
    }

    /**
     * Begins a picture on a white background, whose numbers have up to one decimal.
     *
     * @param title shown by browsers, and read by screen readers
     */
    public static Svg page(double widthPx, double heightPx, double fontPx, String title) {
        return new Svg(1).begin(widthPx, heightPx, "sans-serif", fontPx, title, "\n");
    }

    /**
     * Begins a picture with an XML declaration, whose numbers have up to two decimals.
     *
     * @param fonts names of fonts, the first that a viewer has is used
     */
    public static Svg document(double widthPx, double heightPx, String fonts, double fontPx, String title) {
        var svg = new Svg(2);
        svg.text.append("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
        return svg.begin(widthPx, heightPx, fonts, fontPx, title, "");
    }

    /** Elements without a picture, for {@link #append}; numbers have up to one decimal. */
    public static Svg fragment() {
        return new Svg(1);
    }

    private Svg begin(double width, double height, String fonts, double fontPx, String title, String lineBreak) {
        add(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%s\" height=\"%s\" viewBox=\"0 0 %s %s\" role=\"img\""
                        + " aria-label=\"%s\" font-family=\"%s\" font-size=\"%s\">",
                width, height, width, height, title, fonts, fontPx);
        text.append(lineBreak);
        add("<title>%s</title>\n", title);
        text.append("<rect width=\"100%\" height=\"100%\" fill=\"white\"/>").append(lineBreak);
        return this;
    }

    /**
     * Adds markup. Each place in it takes the next value.
     *
     * @param markup with the places {@code %s} for a text, which is escaped, or for a number without trailing zeros,
     *     {@code %d} for a whole number, and {@code %.1f} for a number with exactly so many decimals
     * @throws IllegalArgumentException if there are more or fewer values than places, or one of the wrong type
     */
    public Svg add(String markup, Object... values) {
        Matcher place = PLACE.matcher(markup);
        int used = 0;
        while (place.find()) {
            if (used == values.length) {
                throw new IllegalArgumentException("there are only " + used + " values for the markup " + markup);
            }
            Object value = values[used++];
            place.appendReplacement(text, "");
            text.append(place.group().equals("%s") ? shown(value) : String.format(Locale.ROOT, place.group(), value));
        }
        place.appendTail(text);
        if (used < values.length) {
            throw new IllegalArgumentException(
                    "there are " + values.length + " values for " + used + " places in the markup " + markup);
        }
        return this;
    }

    private String shown(Object value) {
        return value instanceof Double number ? number(number, decimals) : Xml.escape(value.toString());
    }

    /** Adds all elements of a fragment. */
    public Svg append(Svg fragment) {
        text.append(fragment.text);
        return this;
    }

    /** Adds a line of text; {@code style} holds further attributes. */
    public Svg text(double x, double y, String style, String words) {
        return add("<text x=\"%s\" y=\"%s\" " + style + ">%s</text>\n", x, y, words);
    }

    /** Adds text with a white outline, so that it is readable on lines. */
    public Svg textOnLines(double x, double y, String style, String words) {
        text(x, y, style + " stroke=\"white\" stroke-width=\"3\" stroke-linejoin=\"round\"", words);
        return text(x, y, style, words);
    }

    /** Adds a triangle as arrow head. SVG markers are not supported by all viewers. */
    public Svg arrowHead(double tipX, double tipY, double directionRad, double lengthPx, String colour) {
        double x = StrictMath.cos(directionRad);
        double y = StrictMath.sin(directionRad);
        double baseX = tipX - lengthPx * x;
        double baseY = tipY - lengthPx * y;
        double half = lengthPx * HEAD_SLIMNESS;
        return add(
                "<polygon class=\"head\" points=\"%.1f,%.1f %.1f,%.1f %.1f,%.1f\" fill=\"%s\"/>\n",
                tipX, tipY, baseX - half * y, baseY + half * x, baseX + half * y, baseY - half * x, colour);
    }

    /** The picture as it is now; it may be called again, and more may be added in between. */
    public String end() {
        return text + "</svg>\n";
    }

    /** The value with at most this number of decimals, without trailing zeros. */
    public static String number(double value, int decimals) {
        String number = String.format(Locale.ROOT, "%." + decimals + "f", value);
        String shortest = decimals > 0 ? number.replaceFirst("\\.?0+$", "") : number;
        return shortest.replaceFirst("^-0$", "0");
    }

    /** {@code #rrggbb} of {@code 0x00RRGGBB}. Pure green is darkened, since it is too bright on white. */
    public static String colour(int rgb) {
        return String.format(Locale.ROOT, "#%06x", rgb == PURE_GREEN ? CALM_GREEN : rgb);
    }

    /** A readable text colour on a fill of this colour: black or white. */
    public static String inkOn(int rgb) {
        int shown = rgb == PURE_GREEN ? CALM_GREEN : rgb;
        double light = 0.3 * (shown >> 16 & 0xff) + 0.59 * (shown >> 8 & 0xff) + 0.11 * (shown & 0xff);
        return light > 140 ? "black" : "white";
    }

    /** Upper estimate of the width of a text. */
    public static double width(String words, double fontPx) {
        return words.length() * LETTER * fontPx;
    }

    /** Breaks a text into lines of at most this width, at blanks, and within a word that is longer than a line. */
    public static List<String> wrap(String words, double widthPx, double fontPx) {
        int most = Math.max(1, (int) (widthPx / width("m", fontPx)));
        List<String> lines = new ArrayList<>();
        for (String each : words.split(" ")) {
            String word = each;
            while (word.length() > most) {
                lines.add(word.substring(0, most));
                word = word.substring(most);
            }
            String longer = lines.isEmpty() ? word : lines.getLast() + " " + word;
            if (!lines.isEmpty() && width(longer, fontPx) <= widthPx) {
                lines.set(lines.size() - 1, longer);
            } else {
                lines.add(word);
            }
        }
        return lines;
    }

    /** The smallest of 1, 2 and 5 times a power of ten that is not below {@code least}: a step of a scale. */
    public static double roundStep(double least) {
        double power = StrictMath.pow(10, StrictMath.floor(StrictMath.log10(least)));
        double rest = least / power * (1 - 1e-12);
        return power * (rest <= 1 ? 1 : rest <= 2 ? 2 : rest <= 5 ? 5 : 10);
    }
}
