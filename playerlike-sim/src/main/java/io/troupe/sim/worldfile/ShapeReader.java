package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Shape;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.stream.Stream;

/** Computes the outline of a model: its blocks scaled to fill {@code size}, its boundary, or the plain rectangle. */
final class ShapeReader {
    private static final double SMALLEST_M = 0.001;
    private static final double LARGEST_M = 10_000;
    private static final int MOST_OUTLINES = 1000;
    private static final double BOUNDARY_THICKNESS_M = 0.02;

    private final Units units;
    private final BitmapShapes bitmaps;
    private final Diagnostics diagnostics;

    ShapeReader(Units units, BitmapShapes bitmaps, Diagnostics diagnostics) {
        this.units = units;
        this.bitmaps = bitmaps;
        this.diagnostics = diagnostics;
    }

    /** Width and depth of the body, {@code {x, y}}. */
    double[] size(Entity model) {
        double[] size = model.numbers("size", 0.1, 0.1);
        SourcePosition where = model.whereOf("size");
        for (int i = 0; i < 2; i++) {
            // the default does not depend on the unit of length
            size[i] = model.has("size") ? units.metres(size[i], where) : size[i];
            if (size[i] < SMALLEST_M || size[i] > LARGEST_M) {
                throw new WorldFileException(
                        where, "\"size\" must be from 0.001 to 10000 m in x and y, not " + size[i] + " m");
            }
        }
        return new double[] {size[0], size[1]};
    }

    /** The body in the frame of the pose point. */
    Shape shape(Entity model) {
        double[] size = size(model);
        List<Entity> blocks = Stream.concat(
                        model.children().stream().filter(child -> child.type().equals("block")),
                        Stream.of("block", "polygon").flatMap(word -> outlinesOfStage2(model, word).stream()))
                .toList();
        boolean bitmap = !model.text("bitmap", "").isEmpty();
        if (bitmap && !blocks.isEmpty()) {
            throw new WorldFileException(
                    model.whereOf("bitmap"),
                    "a model has a \"bitmap\" or blocks, not both; the first block is at "
                            + blocks.getFirst().where());
        }
        var shape = new Shape(List.of());
        if (bitmap) {
            shape = bitmaps.shape(model, size);
        } else if (!blocks.isEmpty()) {
            shape = blocks(blocks, size);
        }
        if (model.flag("boundary", false)) {
            shape = shape.with(boundary(size));
        } else if (shape.polygons().isEmpty()) {
            shape = new Shape(List.of(Polygons.rectangle(-size[0] / 2, -size[1] / 2, size[0] / 2, size[1] / 2)));
        }
        return shape.at(units.pose(model, "origin"));
    }

    /**
     * Converts the outlines of Stage 2, {@code polygons 1 polygon[0].points 8 polygon[0].point[0] [ .. ] ..}, to
     * blocks.
     */
    private static List<Entity> outlinesOfStage2(Entity model, String word) {
        int count = model.whole(word + "s", 0);
        if (count < 0 || count > MOST_OUTLINES) {
            throw new WorldFileException(
                    model.whereOf(word + "s"),
                    "\"" + word + "s\" must be from 0 to " + MOST_OUTLINES + ", not " + count);
        }
        var outlines = new ArrayList<Entity>();
        for (int i = 0; i < count; i++) {
            String prefix = Property.key(word, i) + ".";
            Property points = model.properties().get(prefix + "points");
            if (points == null) {
                throw new WorldFileException(
                        model.whereOf(word + "s"),
                        "\"" + word + "s\" is " + count + ", but " + prefix + "points is missing");
            }
            var properties = new LinkedHashMap<String, Property>();
            properties.put("points", points);
            for (int j = 0; j < model.whole(prefix + "points", 0); j++) {
                Property point = model.properties().get(Property.key(prefix + "point", j));
                if (point == null) {
                    break; // BlockReader reports which one
                }
                var renamed = new Property("point", j, point.value(), point.where());
                properties.put(renamed.key(), renamed);
            }
            outlines.add(new Entity("block", points.where(), properties, List.of(), 1, properties.size(), 1));
        }
        return outlines;
    }

    private Shape blocks(List<Entity> blocks, double[] size) {
        List<List<Point>> outlines = blocks.stream()
                .map(block -> BlockReader.read(block, diagnostics))
                .toList();
        Box drawn = Box.around(outlines);
        if (drawn.width() <= 0 || drawn.height() <= 0) {
            throw new WorldFileException(blocks.getFirst().where(), "the block has no area: its points lie on a line");
        }
        var pieces = new ArrayList<List<Point>>();
        var lines = new ArrayList<List<Point>>();
        for (int i = 0; i < blocks.size(); i++) {
            Entity block = blocks.get(i);
            List<Point> outline = outlines.get(i).stream()
                    .map(p -> new Point(
                            (p.x() - drawn.minX()) / drawn.width() * size[0] - size[0] / 2,
                            (p.y() - drawn.minY()) / drawn.height() * size[1] - size[1] / 2))
                    .toList();
            BlockReader.checkSimple(block, outline);
            List<List<Point>> cut = ConvexPieces.of(outline);
            if (cut.isEmpty()) {
                throw new WorldFileException(
                        block.where(), "the block is too thin: scaled to \"size\" it is narrower than a micrometre");
            }
            pieces.addAll(cut);
            lines.addAll(cut.size() == 1 ? cut : List.of(Polygons.counterClockwise(outline)));
        }
        return new Shape(pieces, lines);
    }

    /** Four walls along the inside of the bounding box. */
    private static Shape boundary(double[] size) {
        double x = size[0] / 2;
        double y = size[1] / 2;
        double thick = Math.min(BOUNDARY_THICKNESS_M, Math.min(x, y));
        return new Shape(List.of(
                Polygons.rectangle(-x, -y, x, -y + thick),
                Polygons.rectangle(-x, y - thick, x, y),
                Polygons.rectangle(-x, -y, -x + thick, y),
                Polygons.rectangle(x - thick, -y, x, y)));
    }

    /** Reads the outline in a {@code block ( points N point[0] [x y] .. )}, in the units of the file's author. */
    private static final class BlockReader {
        private static final int MOST_POINTS = 1000;
        private static final double LARGEST = 1e6;

        private BlockReader() {}

        static List<Point> read(Entity block, Diagnostics diagnostics) {
            int count = count(block);
            var outline = new ArrayList<Point>();
            for (int i = 0; i < count; i++) {
                double[] xy = block.numbers(Property.key("point", i));
                var point = new Point(xy[0], xy[1]);
                if (Math.abs(point.x()) > LARGEST || Math.abs(point.y()) > LARGEST) {
                    throw new WorldFileException(
                            block.whereOf(Property.key("point", i)), "a block's coordinates must be within +-1000000");
                }
                outline.add(point);
            }
            return distinct(block, outline, diagnostics);
        }

        private static int count(Entity block) {
            long given = block.properties().values().stream()
                    .filter(p -> p.name().equals("point"))
                    .count();
            int count = block.whole("points", (int) given);
            SourcePosition where = block.whereOf("points");
            if (count < 3 || count > MOST_POINTS) {
                throw new WorldFileException(where, "a block needs 3 to " + MOST_POINTS + " points, not " + count);
            }
            for (int i = 0; i < count; i++) {
                if (!block.has(Property.key("point", i))) {
                    throw new WorldFileException(where, "\"points\" is " + count + ", but point[" + i + "] is missing");
                }
            }
            if (given > count) {
                throw new WorldFileException(where, "\"points\" is " + count + ", but " + given + " points are given");
            }
            return count;
        }

        /** The outline without points that equal the next one; an outline that returns to its start is common. */
        private static List<Point> distinct(Entity block, List<Point> outline, Diagnostics diagnostics) {
            var distinct = new ArrayList<Point>();
            for (int i = 0; i < outline.size(); i++) {
                int next = (i + 1) % outline.size();
                if (!outline.get(i).equals(outline.get(next))) {
                    distinct.add(outline.get(i));
                    continue;
                }
                diagnostics.warn(
                        block.whereOf(Property.key("point", Math.max(i, next))),
                        "point[" + i + "] and point[" + next
                                + "] of a block are the same, and count once: an outline closes by itself");
            }
            if (distinct.size() < 3) {
                throw new WorldFileException(
                        block.whereOf("points"),
                        "a block needs 3 to " + MOST_POINTS + " different points, not " + distinct.size());
            }
            return distinct;
        }

        /** Throws if the outline crosses or touches itself. */
        static void checkSimple(Entity block, List<Point> outline) {
            int n = outline.size();
            for (int i = 0; i < n; i++) {
                Point a = outline.get(i);
                Point b = outline.get((i + 1) % n);
                Point c = outline.get((i + 2) % n);
                boolean turnsBack = Polygons.turn(a, b, c) == 0
                        && (b.x() - a.x()) * (c.x() - b.x()) + (b.y() - a.y()) * (c.y() - b.y()) < 0;
                if (turnsBack) {
                    throw crossing(block, i, (i + 1) % n);
                }
                for (int j = i + 2; j < n; j++) {
                    boolean neighbours = (j + 1) % n == i;
                    if (!neighbours && Polygons.meet(a, b, outline.get(j), outline.get((j + 1) % n))) {
                        throw crossing(block, i, j);
                    }
                }
            }
        }

        private static WorldFileException crossing(Entity block, int i, int j) {
            return new WorldFileException(
                    block.where(),
                    "the block's outline crosses or touches itself: the edge from point[" + i
                            + "] meets the edge from point[" + j + "]");
        }
    }
}
