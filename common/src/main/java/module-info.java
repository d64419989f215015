/** What the modules of Troupe share: reading of text, SVG and DOT, statistics, child processes. */
module io.troupe.common {
    requires static transitive org.jspecify;

    exports io.troupe.common.measure;
    exports io.troupe.common.process;
    exports io.troupe.common.svg;
    exports io.troupe.common.text;
}
