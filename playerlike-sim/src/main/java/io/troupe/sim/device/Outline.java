package io.troupe.sim.device;

import io.troupe.sim.model.Pose;
import io.troupe.sim.model.Shape;
import java.util.List;

/**
 * A body's outline, placed in the world.
 *
 * <p><b>Threads.</b> One thread at a time.
 *
 * <p><b>Cost.</b> Moving it and measuring distances allocate nothing.
 */
public final class Outline {
    private final List<ConvexPolygon> polygons;
    private final List<? extends Ring> rings;
    private double minX;
    private double minY;
    private double maxX;
    private double maxY;

    public Outline(Shape shape, Pose pose) {
        polygons = shape.polygons().stream().map(ConvexPolygon::new).toList();
        rings = shape.outlines().equals(shape.polygons())
                ? polygons
                : shape.outlines().stream().map(Ring::new).toList();
        place(pose);
    }

    /** Moves the body. */
    public void place(Pose pose) {
        place(pose.x(), pose.y(), StrictMath.cos(pose.headingRad()), StrictMath.sin(pose.headingRad()));
    }

    /** Moves the body; the heading is given by its cosine and sine. */
    void place(double x, double y, double cos, double sin) {
        minX = minY = Double.POSITIVE_INFINITY;
        maxX = maxY = Double.NEGATIVE_INFINITY;
        for (int i = 0; i < polygons.size(); i++) {
            ConvexPolygon polygon = polygons.get(i);
            polygon.place(x, y, cos, sin);
            minX = Math.min(minX, polygon.minX);
            minY = Math.min(minY, polygon.minY);
            maxX = Math.max(maxX, polygon.maxX);
            maxY = Math.max(maxY, polygon.maxY);
        }
        if (rings != polygons) {
            for (int i = 0; i < rings.size(); i++) {
                rings.get(i).place(x, y, cos, sin);
            }
        }
    }

    /** Shortest distance from edge to edge; 0 if the bodies touch or overlap. */
    public double gapM(Outline other) {
        return gapM(other, Double.POSITIVE_INFINITY);
    }

    /** The gap to the other body if it is below {@code limitM}, else {@code limitM}. */
    double gapM(Outline other, double limitM) {
        double gap = limitM;
        if (isApart(other, limitM)) {
            return gap;
        }
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

    /** True if the gap is at most {@code distanceM}; cheap if it is much larger. */
    public boolean isWithin(Outline other, double distanceM) {
        return gapM(other, Math.nextUp(distanceM)) <= distanceM;
    }

    /** True if the bodies overlap; touching is not overlapping. */
    public boolean overlaps(Outline other) {
        if (isApart(other, 0)) {
            return false;
        }
        for (int i = 0; i < polygons.size(); i++) {
            for (int j = 0; j < other.polygons.size(); j++) {
                if (polygons.get(i).overlaps(other.polygons.get(j))) {
                    return true;
                }
            }
        }
        return false;
    }

    /** True if the bounding boxes are farther apart than this along x or along y. */
    private boolean isApart(Outline other, double distanceM) {
        return other.minX - maxX > distanceM
                || minX - other.maxX > distanceM
                || other.minY - maxY > distanceM
                || minY - other.maxY > distanceM;
    }

    /** X coordinate of the centre of the bounding box. */
    double centreX() {
        return polygons.isEmpty() ? 0 : (minX + maxX) / 2;
    }

    /** Y coordinate of the centre of the bounding box. */
    double centreY() {
        return polygons.isEmpty() ? 0 : (minY + maxY) / 2;
    }

    List<ConvexPolygon> polygons() {
        return polygons;
    }

    /** The lines that stop rays. */
    List<? extends Ring> rings() {
        return rings;
    }
}
