package io.troupe.petri.drawing;

import java.util.List;

/** The colours of both kinds of drawing; they can be distinguished in greyscale and by colour-blind readers. */
final class Palette {
    static final String LINE = "#333333";
    static final String FAINT = "#9a9a9a";
    static final String BACK = "#8db3d9";
    static final String PATH = "#c4161c";
    static final String PATH_FILL = "#fde3e1";
    static final String DEAD_FILL = "#f4b183";
    static final String MARKED_FILL = "#fff4cc";

    /** The fill of transitions, unless all places around a transition belong to one component. */
    static final String BETWEEN_FILL = "#eeeeee";
    /** The fills of components. */
    static final List<String> TINTS = List.of("#fbd9a8", "#bfdcf5", "#c9e8bd", "#e6cdea", "#f2f0b0", "#d0d0d0");

    private Palette() {}
}
