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
        var begun = new Physics(spec.robots().size(), stepMicros(spec, settings));
        for (ObstacleSpec obstacle : spec.obstacles()) {
            begun.addObstacle(obstacle.pose(), obstacle.blocksBodies() ? obstacle.shape() : NO_SHAPE);
        }
        for (int i = 0; i < spec.robots().size(); i++) {
            RobotSpec robot = spec.robots().get(i);
            begun.addRobot(startPoses.get(i), robot.collisionShape(), robot.massKg(), robot.blocksBodies());
        }
        return begun;
    }

    /**
     * How long the steps are in which jbox2d moves the bodies: the settings' step, or a whole fraction of it in which no point of a robot travels farther than
     * half of a robot's smallest extent. In longer ones fast robots would pass thin walls, and push one another through thick ones.
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

    /** How many parts a step of the settings needs at least. */
    private static int parts(WorldSpec spec, WorldSettings settings) {
        double stepS = settings.physicsStepMicros() / 1e6;
        double travelM = 0;
        double smallestM = Double.POSITIVE_INFINITY;
        for (RobotSpec robot : spec.robots()) {
            List<Point> points = robot.collisionShape().polygons().stream()
                    .flatMap(List::stream)
                    .toList();
            var x = points.stream().mapToDouble(Point::x).summaryStatistics();
            var y = points.stream().mapToDouble(Point::y).summaryStatistics();
            smallestM = Math.min(smallestM, Math.min(x.getMax() - x.getMin(), y.getMax() - y.getMin()));
            double radiusM = points.stream()
                    .mapToDouble(point -> StrictMath.hypot(point.x(), point.y()))
                    .max()
                    .orElseThrow();
            travelM = Math.max(travelM, (settings.maxForwardMps() + settings.maxTurnRadps() * radiusM) * stepS);
        }
        return 1 + (int) Math.min(travelM / (smallestM / 2), settings.physicsStepMicros());
    }
}
