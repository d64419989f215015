package io.troupe.petri.drawing;

import java.util.ArrayList;
import java.util.List;

/**
 * Estimates the size of text. The viewer's fonts are unknown, so the estimate is that of a wide sans-serif font: text
 * may be narrower, but is hardly ever wider.
 */
final class TextMetrics {
    /** The fonts that the drawings ask for. */
    static final String FONTS = "Helvetica, Arial, 'DejaVu Sans', sans-serif";

    private static final double LINE = 1.2;

    private TextMetrics() {}

    static Size size(List<String> lines, double fontPx) {
        var width =
                lines.stream().mapToDouble(line -> width(line, fontPx)).max().orElse(0);
        return new Size(width, lines.size() * lineHeight(fontPx));
    }

    static double lineHeight(double fontPx) {
        return fontPx * LINE;
    }

    static double width(String text, double fontPx) {
        return text.codePoints().mapToDouble(TextMetrics::ems).sum() * fontPx;
    }

    /** Breaks words into as few lines of {@code widthPx} as possible; a longer word gets a separate line. */
    static List<String> wrapped(List<String> words, double fontPx, double widthPx) {
        var lines = new ArrayList<String>();
        for (var word : words) {
            var longer = lines.isEmpty() ? word : lines.getLast() + " " + word;
            if (!lines.isEmpty() && width(longer, fontPx) <= widthPx) {
                lines.set(lines.size() - 1, longer);
            } else {
                lines.add(word);
            }
        }
        return lines;
    }

    private static double ems(int character) {
        if (Character.getType(character) == Character.NON_SPACING_MARK) {
            return 0;
        }
        if (character >= 0x2E80) {
            return 1.1;
        }
        if ("il|'.,:;! jftrI()[]".indexOf(character) >= 0) {
            return 0.42;
        }
        if ("mwMWOQ@%".indexOf(character) >= 0) {
            return 1;
        }
        return Character.isUpperCase(character) ? 0.76 : 0.64;
    }
}
