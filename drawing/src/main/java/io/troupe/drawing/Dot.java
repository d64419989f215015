package io.troupe.drawing;

import java.util.List;

/** Labels in DOT, the language of Graphviz. */
public final class Dot {
    private Dot() {}

    /**
     * A quoted label that shows exactly this text: backslashes, quotes and entities are escaped, a line break is kept.
     */
    public static String quoted(String text) {
        return '"' + escaped(text).replace("\n", "\\n") + '"';
    }

    /** A quoted label of several lines that begin at the same place. */
    public static String leftAligned(List<String> lines) {
        var label = new StringBuilder("\"");
        lines.forEach(line -> label.append(escaped(line)).append("\\l"));
        return label.append('"').toString();
    }

    private static String escaped(String text) {
        return text.replace("&", "&amp;")
                .replace("\\", "\\\\")
                .replace("\"", "\\\"")
                .replace("\r", "");
    }
}
