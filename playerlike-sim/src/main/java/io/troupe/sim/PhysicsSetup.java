package io.troupe.sim;

import io.troupe.sim.model.DriveSpec.Steering;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.physics.Physics;
import java.util.List;
import java.util.function.IntPredicate;
import java.util.stream.Stream;

/** Creates the physics bodies of a world. */
final class PhysicsSetup {
    private static final Shape NO_SHAPE = new Shape(List.of());

    private PhysicsSetup() {}

    /** Creates the physics with all bodies at their start poses. */
    static Physics atStart(WorldSpec spec, WorldSettings settings, StartPoses starts) {
        List<Pose> poses = Stream.concat(
                        starts.poses().stream(),
                        spec.movingObstacles().stream()
                                .map(i -> spec.obstacles().get(i).pose()))
                .toList();
        return at(spec, settings, poses, starts.stuck()::get);
    }

    /**
     * Creates the physics with the robots and the obstacles that move at given poses.
     *
     * @param poses of the robots and, after them, of these obstacles
     * @param held whether a robot is held in place
     */
    static Physics at(WorldSpec spec, WorldSettings settings, List<Pose> poses, IntPredicate held) {
        List<Integer> movers = spec.movingObstacles();
        var begun = Physics.withMovers(spec.robots().size(), stepMicros(spec, settings), movers);
        for (int i = 0; i < spec.obstacles().size(); i++) {
            ObstacleSpec obstacle = spec.obstacles().get(i);
            boolean stands = movers.isEmpty() || !movers.contains(i);
            begun.addObstacle(obstacle.pose(), stands ? blockingShape(obstacle) : NO_SHAPE);
        }
        for (int i = 0; i < spec.robots().size(); i++) {
            RobotSpec robot = spec.robots().get(i);
            begun.addRobot(poses.get(i), robot.collisionShape(), robot.massKg(), robot.blocksBodies());
            if (held.test(i)) {
                begun.hold(i);
            }
        }
        for (int i = 0; i < movers.size(); i++) {
            ObstacleSpec obstacle = spec.obstacles().get(movers.get(i));
            double massKg = obstacle.traits().pushableKg();
            int body = spec.robots().size() + i;
            begun.addRobot(poses.get(body), obstacle.shape(), massKg > 0 ? massKg : 1, obstacle.blocksBodies());
            begun.drive(body, 0, 0);
            if (massKg == 0) {
                begun.hold(body);
            }
        }
        return begun;
    }

    /** What robots collide with. */
    static Shape blockingShape(ObstacleSpec obstacle) {
        return obstacle.blocksBodies() ? obstacle.shape() : NO_SHAPE;
    }

    /**
     * Length of the steps in which jbox2d moves the bodies. It is the settings' step, or the largest whole fraction of
     * it in which no point of a robot travels farther than half the width of that robot's widest convex piece. Within
     * that distance no wall lets the piece pass. With longer steps, fast robots would pass through thin walls and push
     * one another through thick ones. A piece narrower than the widest of its robot, such as a thin arm, may still pass
     * a thin post that only this piece meets.
     */
    static int stepMicros(WorldSpec spec, WorldSettings settings) {
        int longest = settings.physicsStepMicros();
        for (int parts = parts(spec, settings); parts <= longest; parts++) {
            if (longest % parts == 0) {
                return longest / parts;
            }
        }
        return 1;
    }

    /** Minimum number of parts into which a step of the settings must be divided. */
    private static int parts(WorldSpec spec, WorldSettings settings) {
        double stepS = settings.physicsStepMicros() / 1e6;
        double travelM = 0;
        double smallestM = Double.POSITIVE_INFINITY;
        for (RobotSpec robot : spec.robots()) {
            List<List<Point>> pieces = robot.collisionShape().polygons();
            smallestM = Math.min(
                    smallestM,
                    pieces.stream().mapToDouble(PhysicsSetup::widthM).max().orElseThrow());
            double radiusM = pieces.stream()
                    .flatMap(List::stream)
                    .mapToDouble(point -> StrictMath.hypot(point.x(), point.y()))
                    .max()
                    .orElseThrow();
            double mostMps = robot.drive().steering() instanceof Steering.Omnidirectional
                    ? settings.maxForwardMps() * StrictMath.sqrt(2)
                    : settings.maxForwardMps();
            travelM = Math.max(travelM, (mostMps + settings.maxTurnRadps() * radiusM) * stepS);
        }
        for (int mover : spec.movingObstacles()) {
            smallestM = Math.min(
                    smallestM,
                    spec.obstacles().get(mover).shape().polygons().stream()
                            .mapToDouble(PhysicsSetup::widthM)
                            .max()
                            .orElseThrow());
        }
        return 1 + (int) Math.min(travelM / (smallestM / 2), settings.physicsStepMicros());
    }

    /**
     * Width of a convex polygon: the smallest distance between two parallel lines that enclose it. One of the lines
     * always lies along an edge.
     */
    private static double widthM(List<Point> polygon) {
        double narrowestM = Double.POSITIVE_INFINITY;
        for (int i = 0; i < polygon.size(); i++) {
            Point from = polygon.get(i);
            Point to = polygon.get((i + 1) % polygon.size());
            double dx = to.x() - from.x();
            double dy = to.y() - from.y();
            double lengthM = StrictMath.hypot(dx, dy);
            double farthestM = 0;
            for (Point vertex : polygon) {
                double offset = dx * (vertex.y() - from.y()) - dy * (vertex.x() - from.x());
                farthestM = Math.max(farthestM, Math.abs(offset) / lengthM);
            }
            narrowestM = Math.min(narrowestM, farthestM);
        }
        return narrowestM;
    }
}
