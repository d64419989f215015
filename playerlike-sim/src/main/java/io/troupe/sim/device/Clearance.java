package io.troupe.sim.device;

import io.troupe.sim.scenario.Point;
import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.Shape;
import java.util.ArrayList;
import java.util.List;

/** How far a body is from the nearest of several others that stand still. */
public final class Clearance {
    private record Placed(List<Point> polygon, Point centre, double radiusM) {}

    private final List<Placed> obstacles = new ArrayList<>();

    /** Adds something to keep clear of. */
    public void add(Shape shape, Pose pose) {
        shape.polygons().forEach(polygon -> obstacles.add(place(polygon, pose)));
    }

    /** From edge to edge in metres; 0 if they touch or overlap, infinity if there is nothing. */
    public double of(Shape shape, Pose pose) {
        double best = Double.POSITIVE_INFINITY;
        for (var polygon : shape.polygons()) {
            Placed body = place(polygon, pose);
            for (var obstacle : obstacles) {
                double atLeast =
                        StrictMath.hypot(body.centre.x() - obstacle.centre.x(), body.centre.y() - obstacle.centre.y())
                                - body.radiusM
                                - obstacle.radiusM;
                if (atLeast < best) {
                    best = StrictMath.min(best, distance(body.polygon, obstacle.polygon));
                }
            }
        }
        return best;
    }

    private static Placed place(List<Point> polygon, Pose pose) {
        List<Point> placed = polygon.stream().map(pose::place).toList();
        double x = placed.stream().mapToDouble(Point::x).average().orElseThrow();
        double y = placed.stream().mapToDouble(Point::y).average().orElseThrow();
        double radius = placed.stream()
                .mapToDouble(corner -> StrictMath.hypot(corner.x() - x, corner.y() - y))
                .max()
                .orElseThrow();
        return new Placed(placed, new Point(x, y), radius);
    }

    /** Between convex polygons: at a corner of one of them, unless they overlap. */
    private static double distance(List<Point> first, List<Point> second) {
        if (overlap(first, second)) {
            return 0;
        }
        return StrictMath.min(cornersToEdges(first, second), cornersToEdges(second, first));
    }

    private static double cornersToEdges(List<Point> corners, List<Point> polygon) {
        double best = Double.POSITIVE_INFINITY;
        for (Point corner : corners) {
            Point from = polygon.getLast();
            for (Point to : polygon) {
                best = StrictMath.min(best, toSegment(corner, from, to));
                from = to;
            }
        }
        return best;
    }

    private static double toSegment(Point point, Point from, Point to) {
        double dx = to.x() - from.x();
        double dy = to.y() - from.y();
        double part = ((point.x() - from.x()) * dx + (point.y() - from.y()) * dy) / (dx * dx + dy * dy);
        double t = StrictMath.max(0, StrictMath.min(1, part));
        return StrictMath.hypot(from.x() + t * dx - point.x(), from.y() + t * dy - point.y());
    }

    /** Separating axes: convex polygons are apart if some edge of one has all of the other on its outer side. */
    private static boolean overlap(List<Point> first, List<Point> second) {
        return !hasSeparatingEdge(first, second) && !hasSeparatingEdge(second, first);
    }

    private static boolean hasSeparatingEdge(List<Point> polygon, List<Point> other) {
        Point from = polygon.getLast();
        for (Point to : polygon) {
            Point a = from;
            boolean separates = other.stream()
                    .allMatch(p -> (to.x() - a.x()) * (p.y() - a.y()) - (to.y() - a.y()) * (p.x() - a.x()) <= 0);
            if (separates) {
                return true;
            }
            from = to;
        }
        return false;
    }
}
