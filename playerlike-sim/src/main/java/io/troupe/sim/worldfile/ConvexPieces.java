package io.troupe.sim.worldfile;

import io.troupe.sim.model.Point;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.stream.IntStream;

/**
 * Cuts a simple polygon into convex pieces of 3 to 8 vertices: ear clipping, then joining neighbours while the union is
 * convex.
 *
 * <p><b>Cost.</b> About the square of the number of vertices.
 */
final class ConvexPieces {
    /** Limit of the physics. */
    static final int MOST_VERTICES = 8;

    private final List<Point> points;

    private ConvexPieces(List<Point> points) {
        this.points = points;
    }

    /** The pieces, counter-clockwise; empty if the polygon is so thin that it has no ear. */
    static List<List<Point>> of(List<Point> simplePolygon) {
        List<Point> corners = withoutFlat(Polygons.counterClockwise(simplePolygon));
        if (corners.size() < 3) {
            return List.of();
        }
        var cut = new ConvexPieces(corners);
        List<Integer> all = IntStream.range(0, corners.size()).boxed().toList();
        List<List<Integer>> pieces = cut.isConvex(all) ? List.of(all) : cut.joined(cut.triangles());
        return pieces.stream()
                .map(piece -> piece.stream().map(corners::get).toList())
                .toList();
    }

    /** Removes vertices on the straight line between their neighbours. */
    private static List<Point> withoutFlat(List<Point> polygon) {
        var corners = new ArrayList<>(polygon);
        for (int i = 0; i < corners.size() && corners.size() >= 3; ) {
            Point before = corners.get((i + corners.size() - 1) % corners.size());
            Point after = corners.get((i + 1) % corners.size());
            Point corner = corners.get(i);
            if (Polygons.turnsLeft(before, corner, after) || Polygons.turnsLeft(after, corner, before)) {
                i++;
            } else {
                corners.remove(i);
            }
        }
        return corners;
    }

    private List<List<Integer>> triangles() {
        var rest = new ArrayList<>(IntStream.range(0, points.size()).boxed().toList());
        var triangles = new ArrayList<List<Integer>>();
        while (rest.size() > 3) {
            int ear = ear(rest);
            if (ear >= 0) {
                triangles.add(List.of(at(rest, ear - 1), at(rest, ear), at(rest, ear + 1)));
                rest.remove(ear);
                continue;
            }
            // clipping may leave a corner on the line between its neighbours, which encloses no area
            int flat = flat(rest);
            if (flat < 0) {
                return List.of();
            }
            rest.remove(flat);
        }
        if (isConvex(rest)) {
            triangles.add(List.copyOf(rest));
        } else if (flat(rest) < 0) {
            return List.of();
        }
        return triangles;
    }

    /** A corner at which the outline goes straight on or straight back; -1 if there is none. */
    private int flat(List<Integer> polygon) {
        for (int i = 0; i < polygon.size(); i++) {
            Point a = points.get(at(polygon, i - 1));
            Point b = points.get(at(polygon, i));
            Point c = points.get(at(polygon, i + 1));
            if (!Polygons.turnsLeft(a, b, c) && !Polygons.turnsLeft(c, b, a)) {
                return i;
            }
        }
        return -1;
    }

    /** A corner whose triangle with its neighbours lies inside the polygon; -1 if there is none. */
    private int ear(List<Integer> polygon) {
        for (int i = 0; i < polygon.size(); i++) {
            Point a = points.get(at(polygon, i - 1));
            Point b = points.get(at(polygon, i));
            Point c = points.get(at(polygon, i + 1));
            if (Polygons.turnsLeft(a, b, c) && isEmpty(a, b, c, polygon)) {
                return i;
            }
        }
        return -1;
    }

    private boolean isEmpty(Point a, Point b, Point c, List<Integer> polygon) {
        for (int index : polygon) {
            Point p = points.get(index);
            boolean corner = p == a || p == b || p == c;
            if (!corner && Polygons.turn(a, b, p) >= 0 && Polygons.turn(b, c, p) >= 0 && Polygons.turn(c, a, p) >= 0) {
                return false;
            }
        }
        return true;
    }

    private List<List<Integer>> joined(List<List<Integer>> triangles) {
        var open = new ArrayList<>(triangles);
        var done = new ArrayList<List<Integer>>();
        while (!open.isEmpty()) {
            List<Integer> piece = open.removeFirst();
            for (int i = 0; i < open.size(); ) {
                List<Integer> union = union(piece, open.get(i));
                if (!union.isEmpty() && union.size() <= MOST_VERTICES && isConvex(union)) {
                    piece = union;
                    open.remove(i);
                    i = 0;
                } else {
                    i++;
                }
            }
            done.add(piece);
        }
        return done;
    }

    /** The union of two polygons that share an edge; empty if they share none. */
    private static List<Integer> union(List<Integer> one, List<Integer> other) {
        for (int i = 0; i < one.size(); i++) {
            int j = other.indexOf(at(one, i));
            if (j >= 0 && at(other, j - 1).equals(at(one, i + 1))) {
                // one: from the end of the shared edge round to its start; other: the same, without both ends
                var union = new ArrayList<>(one);
                Collections.rotate(union, -(i + 1));
                for (int k = 1; k < other.size() - 1; k++) {
                    union.add(at(other, j + k));
                }
                return union;
            }
        }
        return List.of();
    }

    private boolean isConvex(List<Integer> polygon) {
        if (polygon.size() > MOST_VERTICES) {
            return false;
        }
        for (int i = 0; i < polygon.size(); i++) {
            Point a = points.get(at(polygon, i - 1));
            Point b = points.get(at(polygon, i));
            Point c = points.get(at(polygon, i + 1));
            if (!Polygons.turnsLeft(a, b, c)) {
                return false;
            }
        }
        return true;
    }

    private static Integer at(List<Integer> ring, int index) {
        return ring.get(Math.floorMod(index, ring.size()));
    }
}
