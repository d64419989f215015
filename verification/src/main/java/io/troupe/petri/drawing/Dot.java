package io.troupe.petri.drawing;

/** Quoting for DOT, the language of Graphviz. */
final class Dot {
    private Dot() {}

    /**
     * A quoted label that shows exactly this text: backslashes, quotes and entities are escaped, a line break is kept.
     */
    static String quoted(String text) {
        return '"'
                + text.replace("&", "&amp;")
                        .replace("\\", "\\\\")
                        .replace("\"", "\\\"")
                        .replace("\r", "")
                        .replace("\n", "\\n")
                + '"';
    }
}
