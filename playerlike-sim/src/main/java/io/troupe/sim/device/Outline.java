package io.troupe.sim.device;

import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.Shape;
import java.util.List;

/**
 * A body's edge, placed in the world.
 *
 * <p><b>Threads.</b> One thread at a time.
 * <p><b>Cost.</b> Moving it and measuring from it allocate nothing.
 */
public final class Outline {
    private final List<ConvexPolygon> polygons;

    public Outline(Shape shape, Pose pose) {
        polygons = shape.polygons().stream().map(ConvexPolygon::new).toList();
        place(pose);
    }

    /** Moves the body. */
    public void place(Pose pose) {
        place(pose.x(), pose.y(), StrictMath.cos(pose.headingRad()), StrictMath.sin(pose.headingRad()));
    }

    /** Moves the body; the heading is given by its cosine and sine. */
    void place(double x, double y, double cos, double sin) {
        for (int i = 0; i < polygons.size(); i++) {
            polygons.get(i).place(x, y, cos, sin);
        }
    }

    /** Shortest distance from edge to edge; 0 if the bodies touch or overlap. */
    public double gapM(Outline other) {
        return gapM(other, Double.POSITIVE_INFINITY);
    }

    /** The gap to the other body if it is below {@code limitM}, else {@code limitM}. */
    double gapM(Outline other, double limitM) {
        double gap = limitM;
        for (int i = 0; i < polygons.size(); i++) {
            ConvexPolygon mine = polygons.get(i);
            for (int j = 0; j < other.polygons.size(); j++) {
                ConvexPolygon theirs = other.polygons.get(j);
                if (mine.gapAtLeast(theirs) < gap) {
                    gap = Math.min(gap, mine.gap(theirs));
                }
            }
        }
        return gap;
    }

    /** Whether the bodies reach into each other; touching is not overlapping. */
    public boolean overlaps(Outline other) {
        return polygons.stream().anyMatch(mine -> other.polygons.stream().anyMatch(mine::overlaps));
    }

    /** Middle of the smallest upright rectangle that holds the body. */
    double centreX() {
        double min = polygons.stream().mapToDouble(each -> each.minX).min().orElse(0);
        double max = polygons.stream().mapToDouble(each -> each.maxX).max().orElse(0);
        return (min + max) / 2;
    }

    /** See {@link #centreX}. */
    double centreY() {
        double min = polygons.stream().mapToDouble(each -> each.minY).min().orElse(0);
        double max = polygons.stream().mapToDouble(each -> each.maxY).max().orElse(0);
        return (min + max) / 2;
    }

    List<ConvexPolygon> polygons() {
        return polygons;
    }
}
