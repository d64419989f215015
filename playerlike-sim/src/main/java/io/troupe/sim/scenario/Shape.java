package io.troupe.sim.scenario;

import java.util.List;

/**
 * The outline of a body: convex polygons in the body's own frame, origin at the pose point (a robot's centre of rotation).
 *
 * <p><b>Units and shapes.</b> Metres; each polygon has 3 to 8 vertices, counter-clockwise, convex; one that is not convex in the
 * file has been cut into pieces that are.
 */
public record Shape(List<List<Point>> polygons) {
    public Shape {
        polygons = polygons.stream().map(List::copyOf).toList();
    }
}
