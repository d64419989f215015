package io.troupe.sim;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.device.Position2d;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.physics.Physics;
import io.troupe.sim.worldfile.WorldFileException;
import java.util.List;

/** Rejects worlds that the simulator cannot run correctly. */
final class SpecCheck {
    /**
     * Farthest reach of a robot. Beyond it, single-precision physics is too coarse: a step of 1 mm is rounded by 3 %.
     */
    static final double FARTHEST_M = 500;
    /** Farthest reach of an obstacle: rays still hit it, but robots must not get there. */
    private static final double FARTHEST_WALL_M = 5_000;
    /** Beyond this distance, collisions begin to be coarse, and a warning is logged. */
    private static final double FAR_M = 150;

    private static final double STRAIGHT = 1e-9;

    private SpecCheck() {}

    static void check(WorldSpec spec, WorldSettings settings) {
        checkSteps(spec, settings);
        for (ObstacleSpec obstacle : spec.obstacles()) {
            checkBody(
                    "obstacle '" + obstacle.name() + "'",
                    obstacle.pose(),
                    obstacle.shape(),
                    obstacle.where(),
                    FARTHEST_WALL_M);
        }
        for (RobotSpec robot : spec.robots()) {
            String title = "robot '" + robot.name() + "'";
            checkBody(title, robot.pose(), robot.collisionShape(), robot.where(), FARTHEST_M);
            if (robot.shape().polygons().isEmpty()) {
                throw new WorldFileException(robot.where(), title + " has no body");
            }
            if (!(robot.massKg() > 0 && robot.massKg() < Double.POSITIVE_INFINITY)) {
                throw new WorldFileException(
                        robot.where(), title + " has a mass of " + robot.massKg() + ", expected kilograms above 0");
            }
            if (!Position2d.canReport(robot.startOdometry())) {
                throw new WorldFileException(
                        robot.where(),
                        title + " starts with the odometry " + robot.startOdometry() + ", expected finite numbers of at"
                                + " most " + Position2d.FARTHEST);
            }
        }
        warnIfFar(spec);
    }

    /** Logs one warning if anything is far from the origin, naming what is farthest. */
    private static void warnIfFar(WorldSpec spec) {
        String farthest = "";
        double farthestM = FAR_M;
        for (ObstacleSpec obstacle : spec.obstacles()) {
            double extentM = extentM(obstacle.pose(), obstacle.shape());
            if (extentM > farthestM) {
                farthestM = extentM;
                farthest = "obstacle '" + obstacle.name() + "'";
            }
        }
        for (RobotSpec robot : spec.robots()) {
            double extentM = extentM(robot.pose(), robot.shape());
            if (extentM > farthestM) {
                farthestM = extentM;
                farthest = "robot '" + robot.name() + "'";
            }
        }
        if (farthestM > FAR_M) {
            System.getLogger(SpecCheck.class.getName())
                    .log(
                            System.Logger.Level.WARNING,
                            "{0}: {1} reaches {2} m from the origin along x or y: beyond {3} m collisions get coarse, expected a world"
                                    + " centred on the origin",
                            spec.file(),
                            farthest,
                            Math.round(farthestM),
                            FAR_M);
        }
    }

    private static double extentM(Pose pose, Shape shape) {
        double extentM = 0;
        for (List<Point> polygon : shape.polygons()) {
            for (Point vertex : polygon) {
                Point placed = pose.place(vertex);
                extentM = Math.max(extentM, Math.max(Math.abs(placed.x()), Math.abs(placed.y())));
            }
        }
        return extentM;
    }

    private static void checkSteps(WorldSpec spec, WorldSettings settings) {
        long intervalMicros = spec.intervalMillis() * 1000L;
        int stepMicros = settings.physicsStepMicros();
        if (intervalMicros <= 0 || intervalMicros % stepMicros != 0) {
            throw new WorldFileException(spec.file() + ": the interval of world '" + spec.name() + "' is "
                    + intervalMicros + " us, expected a whole multiple of the physics step of " + stepMicros + " us");
        }
        double travelM = settings.maxForwardMps() * stepMicros / 1e6;
        double turnRad = settings.maxTurnRadps() * stepMicros / 1e6;
        if (travelM > Physics.MAX_TRAVEL_M || turnRad > Physics.MAX_TURN_RAD) {
            throw new IllegalArgumentException("a physics step of " + stepMicros + " us is too long for "
                    + settings.maxForwardMps() + " m/s and " + settings.maxTurnRadps() + " rad/s: a body may move "
                    + Physics.MAX_TRAVEL_M + " m and turn " + Physics.MAX_TURN_RAD + " rad in one step");
        }
    }

    private static void checkBody(String title, Pose pose, Shape shape, SourcePosition where, double farthestM) {
        if (!Double.isFinite(pose.headingRad())) {
            throw new WorldFileException(where, title + " has the heading " + pose.headingRad());
        }
        for (List<Point> polygon : shape.polygons()) {
            if (polygon.size() < 3 || polygon.size() > 8) {
                throw new WorldFileException(
                        where, title + " has a polygon of " + polygon.size() + " vertices, expected 3 to 8");
            }
            for (Point vertex : polygon) {
                Point placed = pose.place(vertex);
                if (!(Math.abs(placed.x()) <= farthestM && Math.abs(placed.y()) <= farthestM)) {
                    throw new WorldFileException(
                            where,
                            title + " reaches to (" + placed.x() + ", " + placed.y() + "), expected at most "
                                    + farthestM + " m from the origin along x and y");
                }
            }
            if (!isConvexCounterClockwise(polygon)) {
                throw new WorldFileException(
                        where, title + " has a polygon that is not convex and counter-clockwise: " + polygon);
            }
        }
    }

    /** True if every vertex lies to the left of every edge, or on its line. */
    private static boolean isConvexCounterClockwise(List<Point> polygon) {
        double area = 0;
        int n = polygon.size();
        for (int i = 0; i < n; i++) {
            Point a = polygon.get(i);
            Point b = polygon.get((i + 1) % n);
            if (a.equals(b)) {
                return false;
            }
            area += a.x() * b.y() - a.y() * b.x();
            for (int k = 2; k < n; k++) {
                Point c = polygon.get((i + k) % n);
                if ((b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x()) < -STRAIGHT) {
                    return false;
                }
            }
        }
        return area > 0;
    }
}
