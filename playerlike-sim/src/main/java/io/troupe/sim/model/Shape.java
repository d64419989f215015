package io.troupe.sim.model;

import java.util.List;
import java.util.stream.Stream;

/**
 * The outline of a body in its own frame, with the origin at the pose point (a robot's centre of rotation).
 *
 * <p><b>Units and shapes.</b> Metres. The same area is given twice: as convex pieces for collisions, and as lines
 * around it for rays, because rays must not see the edges between two pieces.
 *
 * @param polygons the area as pieces of 3 to 8 vertices, counter-clockwise, convex
 * @param outlines the lines around it, each closed, the body to the left: counter-clockwise outside, clockwise around a
 *     hole
 */
public record Shape(List<List<Point>> polygons, List<List<Point>> outlines) {
    public Shape {
        boolean same = outlines.equals(polygons);
        polygons = copy(polygons);
        outlines = same ? polygons : copy(outlines);
    }

    /** Creates a body whose outlines are its pieces. */
    public Shape(List<List<Point>> polygons) {
        this(polygons, polygons);
    }

    private static List<List<Point>> copy(List<List<Point>> rings) {
        return rings.stream().map(List::copyOf).toList();
    }

    /** The union of both bodies. */
    public Shape with(Shape other) {
        return new Shape(join(polygons, other.polygons), join(outlines, other.outlines));
    }

    /** The body moved to the frame in which {@code pose} is given. */
    public Shape at(Pose pose) {
        return pose.equals(Pose.ORIGIN) ? this : new Shape(place(polygons, pose), place(outlines, pose));
    }

    private static List<List<Point>> join(List<List<Point>> one, List<List<Point>> other) {
        return Stream.concat(one.stream(), other.stream()).toList();
    }

    private static List<List<Point>> place(List<List<Point>> rings, Pose pose) {
        return rings.stream()
                .map(ring -> ring.stream().map(pose::place).toList())
                .toList();
    }
}
