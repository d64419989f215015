/** What the modules of Troupe share: reading of text, suggestions, colours by name, installed programs. */
module io.troupe.common {
    requires static transitive org.jspecify;

    exports io.troupe.common.process;
    exports io.troupe.common.text;
}
