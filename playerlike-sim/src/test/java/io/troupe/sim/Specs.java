package io.troupe.sim;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.CargoSpec;
import io.troupe.sim.model.DriveSpec;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.model.WorldSpec;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.List;
import org.jspecify.annotations.Nullable;

/** World specifications for tests, built in code. */
public final class Specs {
    public static final int BLACK = 0x000000;
    public static final int RED = 0xFF0000;
    public static final int GREEN = 0x00FF00;
    public static final int BLUE = 0x0000FF;
    public static final int ORANGE = 0xFFA500;

    private static final double DEGREE = StrictMath.PI / 180;

    private Specs() {}

    public static WorldSpec world(List<RobotSpec> robots, List<ObstacleSpec> obstacles) {
        return new WorldSpec("test", Path.of("test.world"), 100, robots, obstacles);
    }

    public static WorldSpec world(List<RobotSpec> robots, ObstacleSpec... obstacles) {
        return world(robots, List.of(obstacles));
    }

    public static WorldSpec world(RobotSpec robot, ObstacleSpec... obstacles) {
        return world(List.of(robot), List.of(obstacles));
    }

    public static SourcePosition at(int line) {
        return new SourcePosition(Path.of("test.world"), line, 1);
    }

    /** A rectangle whose centre lies at the given point of the body's frame. */
    public static Shape box(double lengthM, double widthM, double centreX) {
        double x = lengthM / 2;
        double y = widthM / 2;
        return new Shape(List.of(List.of(
                new Point(centreX - x, -y),
                new Point(centreX + x, -y),
                new Point(centreX + x, y),
                new Point(centreX - x, y))));
    }

    /** A black box that blocks everything. */
    public static ObstacleSpec wall(String name, double x, double y, double lengthM, double widthM) {
        return box(name, new Pose(x, y, 0), lengthM, widthM, BLACK);
    }

    public static ObstacleSpec box(String name, Pose pose, double lengthM, double widthM, int colour) {
        return new ObstacleSpec(name, pose, box(lengthM, widthM, 0), colour, true, true, true, at(1));
    }

    /** Four black walls, 0.2 m thick, around a square with this inner side. */
    public static List<ObstacleSpec> arena(double sideM) {
        double out = sideM / 2 + 0.1;
        return List.of(
                wall("east", out, 0, 0.2, sideM + 0.4),
                wall("north", 0, out, sideM + 0.4, 0.2),
                wall("west", -out, 0, 0.2, sideM + 0.4),
                wall("south", 0, -out, sideM + 0.4, 0.2));
    }

    /** 0.44 m x 0.38 m, centre of rotation 4 cm ahead of the middle, no devices. */
    public static RobotSpec robot(String name, Pose pose) {
        return robot(name, pose, ORANGE, null, null);
    }

    public static RobotSpec robot(
            String name, Pose pose, int colour, @Nullable SonarSpec sonar, @Nullable BlobfinderSpec blobfinder) {
        return new RobotSpec(
                name,
                pose,
                box(0.44, 0.38, -0.04),
                colour,
                0.44,
                0.38,
                23,
                new Pose(-0.04, 0, 0),
                Pose.ORIGIN,
                sonar,
                blobfinder,
                List.of(),
                true,
                true,
                at(7));
    }

    /** The robot with this cargo. */
    public static RobotSpec carrying(RobotSpec robot, boolean visible, List<CargoSpec> cargo) {
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
                robot.sonar(),
                robot.blobfinder(),
                robot.rangers(),
                robot.blocksRangers(),
                visible,
                robot.blocksBodies(),
                robot.drive(),
                cargo,
                robot.where());
    }

    /** The robot with this drive. */
    public static RobotSpec driving(RobotSpec robot, DriveSpec drive) {
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
                robot.sonar(),
                robot.blobfinder(),
                robot.rangers(),
                robot.blocksRangers(),
                robot.visible(),
                robot.blocksBodies(),
                drive,
                robot.cargo(),
                robot.where());
    }

    /** Sonars in the robot's centre, facing these directions. */
    public static SonarSpec sonars(double... headingsDeg) {
        return new SonarSpec(
                Arrays.stream(headingsDeg)
                        .mapToObj(heading -> new Pose(0, 0, heading * DEGREE))
                        .toList(),
                0,
                5,
                15 * DEGREE);
    }

    /** The front half of a Pioneer's ring. */
    public static SonarSpec pioneerFront() {
        double[][] ring = {
            {0.075, 0.130, 90}, {0.115, 0.115, 50}, {0.150, 0.080, 30}, {0.170, 0.025, 10},
            {0.170, -0.025, -10}, {0.150, -0.080, -30}, {0.115, -0.115, -50}, {0.075, -0.130, -90}
        };
        return new SonarSpec(
                Arrays.stream(ring)
                        .map(mount -> new Pose(mount[0], mount[1], mount[2] * DEGREE))
                        .toList(),
                0,
                5,
                15 * DEGREE);
    }

    /** 80 x 60 pixels, 60 degrees, in the robot's centre. */
    public static BlobfinderSpec camera(double rangeM, Integer... colours) {
        return new BlobfinderSpec(Pose.ORIGIN, 80, 60, rangeM, 60 * DEGREE, List.of(colours));
    }
}
