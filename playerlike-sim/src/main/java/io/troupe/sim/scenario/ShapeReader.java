package io.troupe.sim.scenario;

import java.util.ArrayList;
import java.util.List;

/** Works out the outline of a model: its blocks scaled to fill {@code size}, its boundary, or the plain box. */
final class ShapeReader {
    private static final double SMALLEST_M = 0.001;
    private static final double LARGEST_M = 1000;
    private static final double BOUNDARY_THICKNESS_M = 0.02;

    private ShapeReader() {}

    /** Width and depth of the body, {@code {x, y}}. */
    static double[] size(Entity model, Units units) {
        double[] size = model.numbers("size", 0.1, 0.1);
        SourcePosition where = model.whereOf("size");
        for (int i = 0; i < 2; i++) {
            // the default does not depend on the unit of length
            size[i] = model.has("size") ? units.metres(size[i], where) : size[i];
            if (size[i] < SMALLEST_M || size[i] > LARGEST_M) {
                throw new WorldFileException(
                        where, "\"size\" must be from 0.001 to 1000 m in x and y, not " + size[i] + " m");
            }
        }
        return new double[] {size[0], size[1]};
    }

    /** The outline in the frame of the pose point. */
    static Shape shape(Entity model, double[] size, Pose origin) {
        var pieces = new ArrayList<List<Point>>();
        List<Entity> blocks = model.children().stream()
                .filter(child -> child.type().equals("block"))
                .toList();
        if (!blocks.isEmpty()) {
            pieces.addAll(blocks(blocks, size));
        }
        if (model.flag("boundary", false)) {
            pieces.addAll(boundary(size));
        } else if (blocks.isEmpty()) {
            pieces.add(Polygons.rectangle(-size[0] / 2, -size[1] / 2, size[0] / 2, size[1] / 2));
        }
        return new Shape(pieces.stream()
                .map(piece -> piece.stream().map(origin::place).toList())
                .toList());
    }

    private static List<List<Point>> blocks(List<Entity> blocks, double[] size) {
        List<List<Point>> outlines = blocks.stream().map(BlockReader::read).toList();
        Box drawn = Box.around(outlines);
        if (drawn.width() <= 0 || drawn.height() <= 0) {
            throw new WorldFileException(blocks.getFirst().where(), "the block has no area: its points lie on a line");
        }
        var pieces = new ArrayList<List<Point>>();
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
        }
        return pieces;
    }

    /** Four walls along the inside of the bounding box. */
    private static List<List<Point>> boundary(double[] size) {
        double x = size[0] / 2;
        double y = size[1] / 2;
        double thick = Math.min(BOUNDARY_THICKNESS_M, Math.min(x, y));
        return List.of(
                Polygons.rectangle(-x, -y, x, -y + thick),
                Polygons.rectangle(-x, y - thick, x, y),
                Polygons.rectangle(-x, -y, -x + thick, y),
                Polygons.rectangle(x - thick, -y, x, y));
    }
}
