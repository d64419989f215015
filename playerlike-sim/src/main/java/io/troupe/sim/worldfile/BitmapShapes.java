package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Shape;
import java.nio.file.Path;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

/**
 * Converts bitmaps to walls: the dark pixels, with their bounding box scaled to a size.
 *
 * <p>Each file is read once, however many models use it.
 */
final class BitmapShapes {
    private static final double SMALLEST_PIXEL_M = 0.001;
    private static final int MOST_PIECES = 50_000;
    private static final int MOST_PIECES_OF_A_WORLD = 200_000;

    private record Bitmap(Box box, List<Box> rectangles, List<List<Point>> outlines) {}

    /** The bitmaps that have been read. */
    static final class Cache {
        private final Map<Path, Bitmap> bitmaps = new HashMap<>();
    }

    private final Path mainFile;
    private final Cache cache;
    private final Diagnostics diagnostics;
    private int pieces;

    /** @param mainFile the world file: bitmaps may be beside it */
    BitmapShapes(Path mainFile, Cache cache, Diagnostics diagnostics) {
        this.mainFile = mainFile;
        this.cache = cache;
        this.diagnostics = diagnostics;
    }

    /** The walls of a model's {@code bitmap}, around its pose point. */
    Shape shape(Entity model, double[] size) {
        SourcePosition where = model.whereOf("bitmap");
        Path file = SourceText.sibling(where.file(), mainFile, model.text("bitmap", ""), where);
        Bitmap bitmap = cache.bitmaps.computeIfAbsent(file, missing -> read(missing, where));
        double scaleX = size[0] / bitmap.box.width();
        double scaleY = size[1] / bitmap.box.height();
        if (scaleX < SMALLEST_PIXEL_M || scaleY < SMALLEST_PIXEL_M) {
            throw new WorldFileException(
                    model.whereOf("size"),
                    "the pixels of bitmap " + file + " would be " + scaleX + " m by " + scaleY
                            + " m large; expected at least 0.001 m");
        }
        pieces += bitmap.rectangles.size();
        if (pieces > MOST_PIECES_OF_A_WORLD) {
            throw new WorldFileException(
                    where, "the bitmaps of this world have more than " + MOST_PIECES_OF_A_WORLD + " pieces in all");
        }
        return new Shape(
                bitmap.rectangles.stream()
                        .map(box -> scaled(
                                Polygons.rectangle(box.minX(), box.minY(), box.maxX(), box.maxY()),
                                bitmap.box,
                                scaleX,
                                scaleY))
                        .toList(),
                bitmap.outlines.stream()
                        .map(line -> scaled(line, bitmap.box, scaleX, scaleY))
                        .toList());
    }

    private Bitmap read(Path file, SourcePosition where) {
        Pixels pixels = BitmapFile.read(file, where, diagnostics);
        List<Box> rectangles = pixels.rectangles();
        if (rectangles.size() > MOST_PIECES) {
            throw new WorldFileException(
                    where,
                    "bitmap " + file + " is too ragged: its dark regions make " + rectangles.size()
                            + " rectangles; the limit is " + MOST_PIECES);
        }
        return new Bitmap(pixels.darkBox(), rectangles, pixels.outlines());
    }

    private static List<Point> scaled(List<Point> ring, Box box, double scaleX, double scaleY) {
        double middleX = (box.minX() + box.maxX()) / 2;
        double middleY = (box.minY() + box.maxY()) / 2;
        return ring.stream()
                .map(p -> new Point((p.x() - middleX) * scaleX, (p.y() - middleY) * scaleY))
                .toList();
    }
}
