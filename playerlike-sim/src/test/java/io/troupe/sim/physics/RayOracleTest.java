package io.troupe.sim.physics;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.TestWorlds;
import io.troupe.sim.device.RayGrid;
import io.troupe.sim.scenario.Pose;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import org.jbox2d.collision.shapes.PolygonShape;
import org.jbox2d.common.Vec2;
import org.jbox2d.dynamics.BodyDef;
import org.jbox2d.dynamics.World;
import org.junit.jupiter.api.Test;

/** Our rays against jbox2d's own, which are slower and in single precision. */
class RayOracleTest {
    private static final double REACH_M = 6;
    /** jbox2d turns bodies by a table of sines: its answer must lie between those of our rays this much to both sides. */
    private static final double GRAZING_RAD = 3e-5;

    @Test
    void gridRays_agreeWithJbox2d_toAMillimetre() {
        long seed = 42;
        var random = new Random(seed);
        var world = new World(new Vec2(0, 0));
        var things = new ArrayList<RayGrid.Thing>();
        var poses = new ArrayList<Pose>();
        for (int index = 0; index < 120; index++) {
            double length = 0.1 + random.nextDouble();
            double width = 0.1 + random.nextDouble();
            var pose = new Pose(20 * random.nextDouble() - 10, 20 * random.nextDouble() - 10, 7 * random.nextDouble());
            things.add(new RayGrid.Thing(TestWorlds.box(length, width), index, RayGrid.FOR_RANGERS));
            poses.add(pose);
            var shape = new PolygonShape();
            shape.setAsBox((float) (length / 2), (float) (width / 2));
            var definition = new BodyDef();
            definition.position.set((float) pose.x(), (float) pose.y());
            definition.angle = (float) pose.headingRad();
            world.createBody(definition).createFixture(shape, 0);
        }
        var grid = new RayGrid(things, poses, List.of());
        double largest = 0;
        int hits = 0;
        for (int ray = 0; ray < 20_000; ray++) {
            double x = 22 * random.nextDouble() - 11;
            double y = 22 * random.nextDouble() - 11;
            double heading = 2 * Math.PI * random.nextDouble();
            if (isInside(world, x, y)) {
                continue; // jbox2d does not see a body from within
            }
            double theirs = cast(world, x, y, heading);
            if (theirs < 0.001) {
                continue; // begins on a surface: within for one, outside for the other
            }
            double least = Double.POSITIVE_INFINITY;
            double most = 0;
            for (double aside : new double[] {0, -GRAZING_RAD, GRAZING_RAD}) {
                double ours = grid.cast(x, y, heading + aside, REACH_M, RayGrid.NOBODY, RayGrid.FOR_RANGERS);
                least = Math.min(least, ours);
                most = Math.max(most, ours);
            }
            double difference = Math.max(least - theirs, theirs - most);
            largest = Math.max(largest, difference);
            hits += theirs < REACH_M ? 1 : 0;
        }
        assertThat(hits).as("seed %d", seed).isGreaterThan(5_000);
        assertThat(largest).as("seed %d", seed).isLessThan(0.001);
    }

    private static boolean isInside(World world, double x, double y) {
        var point = new Vec2((float) x, (float) y);
        for (var body = world.getBodyList(); body != null; body = body.getNext()) {
            if (body.getFixtureList().testPoint(point)) {
                return true;
            }
        }
        return false;
    }

    private static double cast(World world, double x, double y, double heading) {
        var from = new Vec2((float) x, (float) y);
        var to = new Vec2((float) (x + REACH_M * Math.cos(heading)), (float) (y + REACH_M * Math.sin(heading)));
        float[] best = {1};
        world.raycast(
                (fixture, point, normal, fraction) -> {
                    best[0] =
                            Math.min(best[0], fraction); // a later hit may be farther: the callback alone does not sort
                    return best[0];
                },
                from,
                to);
        return best[0] * REACH_M;
    }
}
