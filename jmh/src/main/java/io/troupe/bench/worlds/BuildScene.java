package io.troupe.bench.worlds;

import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeNoise;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.RandomWorld;
import java.util.List;
import java.util.Locale;
import java.util.function.IntFunction;

/** The scenes of {@link CompareWorlds} and {@link WorldTable}; the area grows with the number of robots. */
enum BuildScene {
    /** Sixteen sonars and a camera for each robot. */
    FULL(TiledScene::of),
    /** The same with sonars only. */
    SONARS(TiledScene::withSonarsOnly),
    /** Lasers of 180 rays and 8 m among boxes, 1.2 a square metre. */
    LASERS(count -> RandomWorld.arena(1, side(count, 6), 1.2).withRobots(count, BuildScene::withLaser)),
    /** Lasers of 180 rays and 8 m in an open arena. */
    OPEN_LASERS(count -> RandomWorld.arena(1, side(count, 6), 0.03).withRobots(count, BuildScene::withLaser)),
    /** Sonars among boxes, 1.2 a square metre. */
    CLUTTER(count -> RandomWorld.arena(2, side(count, 6), 1.2).withRobots(count)),
    /** Sonars in a cave of ragged rock. */
    CAVE(count -> RandomWorld.cave(3, side(count, 10)).withRobots(count)),
    /** Sonars between long walls. */
    MAZE(count -> RandomWorld.maze(4, cells(count), cells(count), 2.5).withRobots(count)),
    /** Robots so near one another that most of them touch something. */
    CROWDED(count -> RandomWorld.arena(5, side(count, 1.6), 0).withRobots(count));

    private final IntFunction<WorldSpec> maker;

    BuildScene(IntFunction<WorldSpec> maker) {
        this.maker = maker;
    }

    WorldSpec spec(int robotCount) {
        return maker.apply(robotCount);
    }

    @Override
    public String toString() {
        return name().toLowerCase(Locale.ROOT).replace('_', '-');
    }

    private static double side(int robots, double squareMetresEach) {
        return Math.max(8, Math.sqrt(robots * squareMetresEach));
    }

    private static int cells(int robots) {
        return Math.max(4, (int) Math.sqrt(robots * 1.5));
    }

    private static RobotSpec withLaser(RobotSpec robot) {
        var ahead = new Pose(0.1, 0, 0);
        var rays = new RangeSensorSpec(ahead, 0, 8, StrictMath.PI, 180, 0.15, 0.15, RangeNoise.NONE);
        return new RobotSpec(
                robot.name(),
                robot.pose(),
                robot.shape(),
                robot.colour(),
                robot.lengthM(),
                robot.widthM(),
                robot.massKg(),
                robot.origin(),
                robot.startOdometry(),
                null,
                null,
                List.of(new RangerSpec(RangerSpec.Kind.LASER, ahead, 0.15, 0.15, List.of(rays))),
                true,
                true,
                robot.where());
    }
}
