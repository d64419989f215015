package io.troupe.sim.scenario;

import java.util.ArrayList;
import java.util.List;

/** Reads the outline in a {@code block ( points N point[0] [x y] .. )}, in the units of the file's author. */
final class BlockReader {
    private static final int MOST_POINTS = 1000;
    private static final double LARGEST = 1e6;

    private BlockReader() {}

    static List<Point> read(Entity block) {
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
        checkDistinct(block, outline);
        return outline;
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

    private static void checkDistinct(Entity block, List<Point> outline) {
        for (int i = 0; i < outline.size(); i++) {
            int next = (i + 1) % outline.size();
            if (outline.get(i).equals(outline.get(next))) {
                throw new WorldFileException(
                        block.whereOf(Property.key("point", Math.max(i, next))),
                        "point[" + i + "] and point[" + next + "] are the same; a block's outline closes by itself");
            }
        }
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
