package io.troupe.drawing;

/** Text in XML. */
public final class Xml {
    private Xml() {}

    /** The text with its special characters escaped, for the content of an element and for a quoted attribute. */
    public static String escape(String text) {
        return text.replace("&", "&amp;")
                .replace("<", "&lt;")
                .replace(">", "&gt;")
                .replace("\"", "&quot;");
    }
}
