package io.troupe.sim.worldfile;

import io.troupe.sim.model.Point;
import java.util.ArrayList;
import java.util.BitSet;
import java.util.List;

/**
 * Traces the edges of a bitmap's dark regions.
 *
 * <p>Pixels that share an edge are connected. Pixels that share only a corner are not, so the line turns around its own
 * pixel there.
 */
final class PixelOutlines {
    /** East, north, west, south. */
    private static final int[] DX = {1, 0, -1, 0};

    private static final int[] DY = {0, 1, 0, -1};

    private final Pixels pixels;
    /** The eastward edges already traced, by their western end. */
    private final BitSet seen = new BitSet();

    private PixelOutlines(Pixels pixels) {
        this.pixels = pixels;
    }

    /** The lines around all dark regions and their holes, the dark pixels to the left; corners in pixels. */
    static List<List<Point>> trace(Pixels pixels) {
        var outlines = new PixelOutlines(pixels);
        var lines = new ArrayList<List<Point>>();
        for (int y = 0; y < pixels.height; y++) {
            for (int x = 0; x < pixels.width; x++) {
                // every closed line has an eastward edge
                boolean lowerEdge = pixels.isDark(x, y) && !pixels.isDark(x, y - 1);
                if (lowerEdge && !outlines.seen.get(y * pixels.width + x)) {
                    lines.add(outlines.follow(x, y));
                }
            }
        }
        return lines;
    }

    private List<Point> follow(int startX, int startY) {
        var corners = new ArrayList<Point>();
        int x = startX;
        int y = startY;
        int direction = 0;
        do {
            if (direction == 0) {
                seen.set(y * pixels.width + x);
            }
            x += DX[direction];
            y += DY[direction];
            int next = turn(x, y, direction);
            if (next != direction) {
                corners.add(new Point(x, y));
                direction = next;
            }
        } while (x != startX || y != startY || direction != 0);
        return corners;
    }

    private int turn(int x, int y, int direction) {
        if (!isDarkAhead(x, y, direction, true)) {
            return (direction + 1) % 4;
        }
        return isDarkAhead(x, y, direction, false) ? (direction + 3) % 4 : direction;
    }

    /** True if the pixel beyond a corner, to the left or to the right of the direction, is dark. */
    private boolean isDarkAhead(int x, int y, int direction, boolean left) {
        int toLeft = (direction + 1) % 4;
        int side = left ? 1 : -1;
        // twice the offset from the corner to the pixel's centre
        int offX = DX[direction] + side * DX[toLeft];
        int offY = DY[direction] + side * DY[toLeft];
        return pixels.isDark(x + (offX - 1) / 2, y + (offY - 1) / 2);
    }
}
