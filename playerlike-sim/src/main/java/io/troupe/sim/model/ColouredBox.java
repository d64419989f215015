package io.troupe.sim.model;

import io.troupe.common.text.SourcePosition;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;

/**
 * A box that is put into a world while it runs: a square of {@value #SIDE_M} m along the axes of the world, as an
 * obstacle for bodies, rangers and cameras.
 *
 * {@snippet :
 * world.putBox(new ColouredBox(1, 0xFF0000, 2.5, -1));
 * }
 *
 * @param number from 1 to {@value #MOST}; a box with the number of another one replaces it
 * @param colour {@code 0x00RRGGBB}
 * @param x of its centre, in metres
 * @param y of its centre, in metres
 */
public record ColouredBox(int number, int colour, double x, double y) {
    public static final double SIDE_M = 0.4;
    public static final int MOST = 20;

    private static final SourcePosition NOWHERE = new SourcePosition(Path.of("box"), 1, 1);

    public ColouredBox {
        if (number < 1 || number > MOST) {
            throw new IllegalArgumentException("box " + number + ", expected a number from 1 to " + MOST);
        }
        if (colour < 0 || colour > 0xFFFFFF) {
            throw new IllegalArgumentException("box " + number + " has the colour " + colour
                    + ", expected red, green and blue in the lowest 24 bits");
        }
        if (!Double.isFinite(x) || !Double.isFinite(y)) {
            throw new IllegalArgumentException(
                    "box " + number + " is put at (" + x + " m, " + y + " m), expected finite numbers");
        }
    }

    /** As words of a recording: number, colour in hexadecimal digits, and place. */
    public String words() {
        return number + " " + String.format(Locale.ROOT, "%06x", colour) + " " + x + " " + y;
    }

    /**
     * Reads {@link #words}.
     *
     * @throws IllegalArgumentException with the word that is wrong
     */
    public static ColouredBox parse(List<String> words) {
        if (words.size() != 4) {
            throw new IllegalArgumentException(
                    "a box has " + words.size() + " words, expected its number, its colour, x and y");
        }
        return new ColouredBox(number(words.get(0)), colour(words.get(1)), metres(words.get(2)), metres(words.get(3)));
    }

    /**
     * Reads the number of a box.
     *
     * @throws IllegalArgumentException if it is none
     */
    public static int number(String word) {
        int number = word.matches("[0-9]{1,6}") ? Integer.parseInt(word) : 0;
        if (number < 1 || number > MOST) {
            throw new IllegalArgumentException("box '" + word + "', expected a number from 1 to " + MOST);
        }
        return number;
    }

    private static int colour(String word) {
        if (!word.matches("[0-9a-fA-F]{6}")) {
            throw new IllegalArgumentException("colour '" + word + "', expected six hexadecimal digits");
        }
        return Integer.parseInt(word, 16);
    }

    private static double metres(String word) {
        if (!word.matches("[-+]?[0-9]{1,20}(\\.[0-9]{0,20})?([eE][-+]?[0-9]{1,3})?")) {
            throw new IllegalArgumentException("'" + word + "', expected a number of metres");
        }
        return Double.parseDouble(word);
    }

    public String name() {
        return "box " + number;
    }

    /** The box as an obstacle of a world. */
    public ObstacleSpec obstacle() {
        double half = SIDE_M / 2;
        var square = new Shape(List.of(List.of(
                new Point(-half, -half), new Point(half, -half), new Point(half, half), new Point(-half, half))));
        return new ObstacleSpec(name(), new Pose(x, y, 0), square, colour, true, true, true, NOWHERE);
    }
}
