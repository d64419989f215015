package io.troupe.services.subsumption;

/** The colours of the paper, {@code 0x00RRGGBB}. */
public final class Colours {
    /** State 1, the default. */
    public static final int BLUE = 0x0000FF;
    /** State 2. */
    public static final int RED = 0xFF0000;
    /** State 3. */
    public static final int GREEN = 0x00FF00;
    /** Robot 1. */
    public static final int ORANGE = 0xFFA500;
    /** Robot 2, and the walls. */
    public static final int BLACK = 0x000000;

    private Colours() {}

    /** The colour's name if it is one of the paper's, else {@code #RRGGBB}. */
    public static String name(int colour) {
        return switch (colour) {
            case BLUE -> "blue";
            case RED -> "red";
            case GREEN -> "green";
            case ORANGE -> "orange";
            case BLACK -> "black";
            default -> String.format("#%06X", colour);
        };
    }
}
