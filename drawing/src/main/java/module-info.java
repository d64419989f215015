/** Pictures as text: SVG and DOT. */
module io.troupe.drawing {
    requires static transitive org.jspecify;

    exports io.troupe.drawing;
}
