package io.troupe.sim.physics;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.Specs;
import io.troupe.sim.device.Scene;
import io.troupe.sim.device.Sonar;
import io.troupe.sim.scenario.ObstacleSpec;
import io.troupe.sim.scenario.Point;
import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.RobotSpec;
import io.troupe.sim.scenario.Shape;
import io.troupe.sim.scenario.SonarSpec;
import io.troupe.sim.scenario.WorldSpec;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import org.jbox2d.callbacks.RayCastCallback;
import org.jbox2d.collision.shapes.PolygonShape;
import org.jbox2d.common.Vec2;
import org.jbox2d.dynamics.Body;
import org.jbox2d.dynamics.BodyDef;
import org.jbox2d.dynamics.Fixture;
import org.jbox2d.dynamics.World;
import org.junit.jupiter.api.Test;

/** Our ray casts against jbox2d's, which know nothing of each other. */
class RayOracleTest {
    private static final int PLACES = 200;
    private static final int RAYS_PER_PLACE = 100;
    private static final double RANGE_M = 8;

    private final Random random = new Random(4711);

    private double within(double bound) {
        return (2 * random.nextDouble() - 1) * bound;
    }

    private Pose somewhere(double bound) {
        return new Pose(within(bound), within(bound), within(StrictMath.PI));
    }

    /** Three to eight corners on a circle, counter-clockwise. */
    private Shape polygon() {
        int corners = 3 + random.nextInt(6);
        double radius = 0.2 + random.nextDouble();
        double turn = within(StrictMath.PI);
        List<Point> points = new ArrayList<>();
        for (int i = 0; i < corners; i++) {
            double angle = turn + 2 * StrictMath.PI * (i + 0.4 * random.nextDouble()) / corners;
            points.add(new Point(radius * StrictMath.cos(angle), radius * StrictMath.sin(angle)));
        }
        return new Shape(List.of(points));
    }

    private WorldSpec crowdedWorld() {
        List<ObstacleSpec> obstacles = new ArrayList<>(Specs.arena(16));
        for (int i = 0; i < 40; i++) {
            obstacles.add(new ObstacleSpec(
                    "rock" + i, somewhere(7.5), polygon(), Specs.RED, true, true, true, Specs.at(1)));
        }
        obstacles.add(new ObstacleSpec(
                "beam", new Pose(0, 0, 0.6), Specs.box(12, 0.1, 0), Specs.RED, true, true, true, Specs.at(1)));
        List<RobotSpec> robots = new ArrayList<>();
        for (int i = 0; i < 10; i++) {
            robots.add(Specs.robot("r" + i, somewhere(7.5)));
        }
        return Specs.world(robots, obstacles);
    }

    @Test
    void gridRays_agreeWithGuardedRaysOfJbox2d() {
        WorldSpec spec = crowdedWorld();
        var scene = new Scene(spec);
        World oracle = new World(new Vec2(0, 0));
        spec.obstacles().forEach(obstacle -> add(oracle, obstacle.pose(), obstacle.shape(), "thing"));
        List<Body> robots = new ArrayList<>();
        for (RobotSpec robot : spec.robots()) {
            robots.add(add(oracle, robot.pose(), robot.shape(), robot.name()));
        }
        double largest = 0;
        int hits = 0;
        for (int place = 0; place < PLACES; place++) {
            int robot = place % robots.size();
            Pose pose = somewhere(7.9);
            scene.place(robot, pose);
            scene.refresh();
            List<Pose> mounts = new ArrayList<>();
            for (int i = 0; i < RAYS_PER_PLACE; i++) {
                mounts.add(new Pose(within(0.2), within(0.2), within(StrictMath.PI)));
            }
            List<Double> ours = new Sonar(new SonarSpec(mounts, 0, RANGE_M, 0.1)).read(scene, robot);
            // what casts the rays is left out of the oracle's world; others see it where it was put
            oracle.destroyBody(robots.get(robot));
            for (int i = 0; i < RAYS_PER_PLACE; i++) {
                double theirs = castM(oracle, pose.compose(mounts.get(i)));
                largest = Math.max(largest, Math.abs(ours.get(i) - theirs));
                hits += theirs < RANGE_M ? 1 : 0;
            }
            robots.set(robot, add(oracle, pose, spec.robots().get(robot).shape(), "robot"));
        }
        assertThat(hits).as("rays that hit something").isGreaterThan(PLACES * RAYS_PER_PLACE * 8 / 10);
        assertThat(largest).as("largest difference in metres").isLessThan(0.001);
    }

    private static Body add(World oracle, Pose pose, Shape shape, String name) {
        var definition = new BodyDef();
        definition.userData = name;
        Body body = oracle.createBody(definition);
        for (List<Point> polygon : shape.polygons()) {
            Vec2[] vertices = polygon.stream()
                    .map(pose::place)
                    .map(point -> new Vec2((float) point.x(), (float) point.y()))
                    .toArray(Vec2[]::new);
            var outline = new PolygonShape();
            outline.set(vertices, vertices.length);
            body.createFixture(outline, 0);
        }
        return body;
    }

    private static double castM(World oracle, Pose from) {
        var nearest = new Nearest();
        var start = new Vec2((float) from.x(), (float) from.y());
        var end = new Vec2(
                (float) (from.x() + RANGE_M * StrictMath.cos(from.headingRad())),
                (float) (from.y() + RANGE_M * StrictMath.sin(from.headingRad())));
        oracle.raycast(nearest, start, end);
        return nearest.fraction * RANGE_M;
    }

    private static final class Nearest implements RayCastCallback {
        private float fraction = 1;

        @Override
        public float reportFixture(Fixture fixture, Vec2 point, Vec2 normal, float hitFraction) {
            fraction = Math.min(fraction, hitFraction);
            return fraction;
        }
    }
}
