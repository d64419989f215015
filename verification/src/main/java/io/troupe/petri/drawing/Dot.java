package io.troupe.petri.drawing;

/** What Graphviz' language asks of text. */
final class Dot {
    private Dot() {}

    /**
     * A quoted label that shows exactly this text: backslashes, quotes and entities mean nothing, a line break is one.
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
