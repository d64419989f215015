package io.troupe.sim.worldfile;

import java.util.ArrayList;
import java.util.List;

/** Cuts a bitmap's dark regions into rectangles: runs of pixels, joined with equal runs of the next line. */
final class PixelRectangles {
    private PixelRectangles() {}

    /** Rectangles that cover the dark pixels without overlap, from runs along x or along y, whichever gives fewer. */
    static List<Box> cut(Pixels pixels) {
        List<Box> ofRows = joinedRows(pixels);
        List<Box> ofColumns = joinedRows(pixels.transposed());
        return ofRows.size() <= ofColumns.size()
                ? ofRows
                : ofColumns.stream()
                        .map(box -> new Box(box.minY(), box.minX(), box.maxY(), box.maxX()))
                        .toList();
    }

    private static List<Box> joinedRows(Pixels pixels) {
        var boxes = new ArrayList<Box>();
        int[] startedAt = new int[pixels.width]; // row in which the open box that starts at column x started
        int[] endsAt = new int[pixels.width]; // column after it, 0 if there is none
        for (int y = 0; y <= pixels.height; y++) {
            int[] runs = runs(pixels, y);
            for (int x = 0; x < pixels.width; x++) {
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
    private static int[] runs(Pixels pixels, int y) {
        int[] runs = new int[pixels.width];
        for (int x = 0; x < pixels.width; x++) {
            int start = x;
            while (pixels.isDark(x, y)) {
                x++;
            }
            if (x > start) {
                runs[start] = x;
            }
        }
        return runs;
    }
}
