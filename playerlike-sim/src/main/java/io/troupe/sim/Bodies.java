package io.troupe.sim;

import io.troupe.sim.physics.Physics;
import io.troupe.sim.scenario.ObstacleSpec;
import io.troupe.sim.scenario.Point;
import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.RobotSpec;
import io.troupe.sim.scenario.Shape;
import io.troupe.sim.scenario.WorldSpec;
import java.util.List;

/** Puts the bodies of a world into the physics. */
final class Bodies {
    private static final Shape NO_SHAPE = new Shape(List.of());

    private Bodies() {}

    /** All bodies of a world where they start. */
    static Physics atStart(WorldSpec spec, WorldSettings settings, List<Pose> startPoses) {
        var begun = new Physics(spec.robots().size(), settings.physicsStepMicros(), sweepM(spec, settings));
        for (ObstacleSpec obstacle : spec.obstacles()) {
            begun.addObstacle(obstacle.pose(), obstacle.blocksBodies() ? obstacle.shape() : NO_SHAPE);
        }
        for (int i = 0; i < spec.robots().size(); i++) {
            RobotSpec robot = spec.robots().get(i);
            begun.addRobot(startPoses.get(i), robot.collisionShape(), robot.massKg(), robot.blocksBodies());
        }
        return begun;
    }

    /** How far a point of a robot may travel in one step; 0 if that is less than half of every robot's smallest extent. */
    private static double sweepM(WorldSpec spec, WorldSettings settings) {
        double stepS = settings.physicsStepMicros() / 1e6;
        double sweepM = 0;
        boolean fast = false;
        for (RobotSpec robot : spec.robots()) {
            List<Point> points = robot.collisionShape().polygons().stream()
                    .flatMap(List::stream)
                    .toList();
            var x = points.stream().mapToDouble(Point::x).summaryStatistics();
            var y = points.stream().mapToDouble(Point::y).summaryStatistics();
            double smallestM = Math.min(x.getMax() - x.getMin(), y.getMax() - y.getMin());
            double radiusM = points.stream()
                    .mapToDouble(point -> StrictMath.hypot(point.x(), point.y()))
                    .max()
                    .orElseThrow();
            double travelM = (settings.maxForwardMps() + settings.maxTurnRadps() * radiusM) * stepS;
            sweepM = Math.max(sweepM, travelM);
            fast |= travelM >= smallestM / 2;
        }
        return fast ? sweepM : 0;
    }
}
