package io.troupe.sim.worldfile;

import io.troupe.sim.model.Point;
import java.util.ArrayList;
import java.util.BitSet;
import java.util.List;

/** The dark pixels of a bitmap, and the shapes that they form. Row 0 is the lowest, unlike in an image. */
final class Pixels {
    final int width;
    final int height;
    private final BitSet dark;

    Pixels(int width, int height) {
        this.width = width;
        this.height = height;
        dark = new BitSet(width * height);
    }

    void darken(int x, int y) {
        dark.set(y * width + x);
    }

    /** True if the pixel is dark; pixels outside the bitmap are not. */
    boolean isDark(int x, int y) {
        return x >= 0 && y >= 0 && x < width && y < height && dark.get(y * width + x);
    }

    int darkCount() {
        return dark.cardinality();
    }

    /** Bounding box of the dark pixels, in pixels; there must be at least one. */
    Box darkBox() {
        int minX = width;
        int maxX = 0;
        for (int at = dark.nextSetBit(0); at >= 0; at = dark.nextSetBit(at + 1)) {
            minX = Math.min(minX, at % width);
            maxX = Math.max(maxX, at % width + 1);
        }
        int minY = dark.nextSetBit(0) / width;
        int maxY = dark.previousSetBit(width * height - 1) / width + 1;
        return new Box(minX, minY, maxX, maxY);
    }

    /** The bitmap mirrored at its diagonal, so that columns become rows. */
    private Pixels transposed() {
        var turned = new Pixels(height, width);
        for (int at = dark.nextSetBit(0); at >= 0; at = dark.nextSetBit(at + 1)) {
            turned.darken(at / width, at % width);
        }
        return turned;
    }

    /**
     * Rectangles that cover the dark pixels without overlap: runs of pixels, joined with equal runs of the next line.
     * The runs are along x or along y, whichever gives fewer.
     */
    List<Box> rectangles() {
        List<Box> ofRows = joinedRows();
        List<Box> ofColumns = transposed().joinedRows();
        return ofRows.size() <= ofColumns.size()
                ? ofRows
                : ofColumns.stream()
                        .map(box -> new Box(box.minY(), box.minX(), box.maxY(), box.maxX()))
                        .toList();
    }

    private List<Box> joinedRows() {
        var boxes = new ArrayList<Box>();
        int[] startedAt = new int[width]; // row in which the open box that starts at column x started
        int[] endsAt = new int[width]; // column after it, 0 if there is none
        for (int y = 0; y <= height; y++) {
            int[] runs = runs(y);
            for (int x = 0; x < width; x++) {
                if (endsAt[x] != runs[x]) {
                    if (endsAt[x] != 0) {
                        boxes.add(new Box(x, startedAt[x], endsAt[x], y));
                    }
                    startedAt[x] = y;
                    endsAt[x] = runs[x];
                }
            }
        }
        return boxes;
    }

    /** For each column in which a run of a row starts, the column after its end; 0 where none starts. */
    private int[] runs(int y) {
        int[] runs = new int[width];
        for (int x = 0; x < width; x++) {
            int start = x;
            while (isDark(x, y)) {
                x++;
            }
            if (x > start) {
                runs[start] = x;
            }
        }
        return runs;
    }

    /** The lines around all dark regions and their holes, the dark pixels to the left; corners in pixels. */
    List<List<Point>> outlines() {
        var outlines = new Outlines(this);
        var lines = new ArrayList<List<Point>>();
        for (int y = 0; y < height; y++) {
            for (int x = 0; x < width; x++) {
                // every closed line has an eastward edge
                boolean lowerEdge = isDark(x, y) && !isDark(x, y - 1);
                if (lowerEdge && !outlines.seen.get(y * width + x)) {
                    lines.add(outlines.follow(x, y));
                }
            }
        }
        return lines;
    }

    /**
     * Traces the edges of a bitmap's dark regions.
     *
     * <p>Pixels that share an edge are connected. Pixels that share only a corner are not, so the line turns around its
     * own pixel there.
     */
    private static final class Outlines {
        /** East, north, west, south. */
        private static final int[] DX = {1, 0, -1, 0};

        private static final int[] DY = {0, 1, 0, -1};

        private final Pixels pixels;
        /** The eastward edges already traced, by their western end. */
        private final BitSet seen = new BitSet();

        private Outlines(Pixels pixels) {
            this.pixels = pixels;
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
}
