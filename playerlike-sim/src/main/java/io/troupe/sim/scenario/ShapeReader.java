package io.troupe.sim.scenario;

import java.nio.file.Path;
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

    /** @param mainFile the world file: bitmaps may be beside it */
    ShapeReader(Units units, Path mainFile) {
        this.units = units;
        bitmaps = new BitmapShapes(mainFile);
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

    private static Shape blocks(List<Entity> blocks, double[] size) {
        List<List<Point>> outlines = blocks.stream().map(BlockReader::read).toList();
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
}
