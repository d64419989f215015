package io.troupe.sim.physics;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.Specs;
import io.troupe.sim.TestWorlds;
import io.troupe.sim.device.Scene;
import io.troupe.sim.device.Sonar;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.SonarSpec;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.stream.IntStream;
import org.jbox2d.collision.shapes.PolygonShape;
import org.jbox2d.common.Vec2;
import org.jbox2d.dynamics.BodyDef;
import org.junit.jupiter.api.Test;

/** Compares our rays with those of jbox2d, which are slower and in single precision. */
class RayOracleTest {
    private static final double REACH_M = 6;
    private static final int PLACES = 1_200;
    private static final int RAYS = 400;
    /**
     * jbox2d rotates bodies by a sine table: its result must lie between those of our rays at this angle to both sides.
     */
    private static final double GRAZING_RAD = 3e-5;

    @Test
    void sonarRays_agreeWithJbox2d_toAMillimetre() {
        long seed = 42;
        var random = new Random(seed);
        List<ObstacleSpec> obstacles = obstacles(random);
        var oracle = new org.jbox2d.dynamics.World(new Vec2(0, 0));
        obstacles.forEach(obstacle -> addTo(oracle, obstacle));
        var scene = new Scene(Specs.world(List.of(Specs.robot("r", Pose.ORIGIN)), obstacles));
        var straight = new Sonar(fan(0));
        var left = new Sonar(fan(GRAZING_RAD));
        var right = new Sonar(fan(-GRAZING_RAD));
        double largest = 0;
        int hits = 0;
        for (int place = 0; place < PLACES; place++) {
            Pose pose = freePlace(obstacles, random);
            scene.place(0, pose);
            scene.refresh();
            List<Double> ahead = straight.read(scene, 0);
            List<Double> toTheLeft = left.read(scene, 0);
            List<Double> toTheRight = right.read(scene, 0);
            for (int ray = 0; ray < RAYS; ray++) {
                double theirs = cast(oracle, pose, pose.headingRad() + headingRad(ray));
                double least = Math.min(ahead.get(ray), Math.min(toTheLeft.get(ray), toTheRight.get(ray)));
                double most = Math.max(ahead.get(ray), Math.max(toTheLeft.get(ray), toTheRight.get(ray)));
                largest = Math.max(largest, Math.max(least - theirs, theirs - most));
                hits += theirs < REACH_M ? 1 : 0;
            }
        }
        assertThat(PLACES * RAYS).isEqualTo(480_000);
        assertThat(hits).as("hits, seed %d", seed).isGreaterThan(200_000);
        assertThat(largest).as("metres of difference, seed %d", seed).isLessThan(0.001);
    }

    private static double headingRad(int ray) {
        return ray * 2 * StrictMath.PI / RAYS;
    }

    private static SonarSpec fan(double asideRad) {
        return new SonarSpec(
                IntStream.range(0, RAYS)
                        .mapToObj(ray -> new Pose(0, 0, headingRad(ray) + asideRad))
                        .toList(),
                0,
                REACH_M,
                0.1);
    }

    private static Pose freePlace(List<ObstacleSpec> obstacles, Random random) {
        while (true) {
            var pose = new Pose(22 * random.nextDouble() - 11, 22 * random.nextDouble() - 11, random.nextDouble());
            if (!isCrowded(obstacles, pose)) {
                return pose;
            }
        }
    }

    private static List<ObstacleSpec> obstacles(Random random) {
        var obstacles = new ArrayList<ObstacleSpec>();
        for (int index = 0; index < 120; index++) {
            var pose = new Pose(20 * random.nextDouble() - 10, 20 * random.nextDouble() - 10, 7 * random.nextDouble());
            var shape = TestWorlds.box(0.1 + random.nextDouble(), 0.1 + random.nextDouble());
            obstacles.add(new ObstacleSpec("box " + index, pose, shape, 0, true, true, true, TestWorlds.NOWHERE));
        }
        return obstacles;
    }

    private static void addTo(org.jbox2d.dynamics.World oracle, ObstacleSpec obstacle) {
        var corner = obstacle.shape().polygons().getFirst().get(2);
        var shape = new PolygonShape();
        shape.setAsBox((float) corner.x(), (float) corner.y());
        var definition = new BodyDef();
        definition.position.set(
                (float) obstacle.pose().x(), (float) obstacle.pose().y());
        definition.angle = (float) obstacle.pose().headingRad();
        oracle.createBody(definition).createFixture(shape, 0);
    }

    /** True if a robot of 10 cm does not fit at this pose. */
    private static boolean isCrowded(List<ObstacleSpec> obstacles, Pose pose) {
        return obstacles.stream()
                .anyMatch(each ->
                        StrictMath.hypot(each.pose().x() - pose.x(), each.pose().y() - pose.y()) < 0.9);
    }

    private static double cast(org.jbox2d.dynamics.World oracle, Pose pose, double heading) {
        var from = new Vec2((float) pose.x(), (float) pose.y());
        var to = new Vec2(
                (float) (pose.x() + REACH_M * Math.cos(heading)), (float) (pose.y() + REACH_M * Math.sin(heading)));
        float[] best = {1};
        oracle.raycast(
                (fixture, point, normal, fraction) -> {
                    // a later hit may be farther: the callback receives hits unsorted
                    best[0] = Math.min(best[0], fraction);
                    return best[0];
                },
                from,
                to);
        return best[0] * REACH_M;
    }
}
