package io.troupe.sim;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.model.WorldSpec;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.stream.IntStream;

/** Small worlds built in code. */
public final class TestWorlds {
    public static final int BLACK = 0;
    public static final int RED = 0xFF0000;
    public static final int GREEN = 0x00FF00;
    public static final SourcePosition NOWHERE = new SourcePosition(Path.of("test.world"), 1, 1);
    /** Facing left, ahead, right and back; at the centre of rotation. */
    public static final SonarSpec CROSS = new SonarSpec(
            IntStream.of(90, 0, -90, 180)
                    .mapToObj(degrees -> new Pose(0, 0, StrictMath.toRadians(degrees)))
                    .toList(),
            0,
            5,
            StrictMath.toRadians(15));
    /** 80 columns of one degree, 5 m. */
    public static final BlobfinderSpec CAMERA =
            new BlobfinderSpec(Pose.ORIGIN, 80, 60, 5, StrictMath.toRadians(80), List.of());

    private TestWorlds() {}

    /** A rectangle around the origin. */
    public static Shape box(double lengthM, double widthM) {
        double x = lengthM / 2;
        double y = widthM / 2;
        return new Shape(List.of(List.of(new Point(-x, -y), new Point(x, -y), new Point(x, y), new Point(-x, y))));
    }

    public static ObstacleSpec wall(String name, double x, double y, double lengthM, double widthM, int colour) {
        return new ObstacleSpec(name, new Pose(x, y, 0), box(lengthM, widthM), colour, true, true, true, NOWHERE);
    }

    /** 0.4 m by 0.3 m, with the sonar cross and the camera. */
    public static RobotSpec robot(String name, double x, double y, double headingRad) {
        return new RobotSpec(
                name,
                new Pose(x, y, headingRad),
                box(0.4, 0.3),
                0xFFA500,
                0.4,
                0.3,
                10,
                Pose.ORIGIN,
                Pose.ORIGIN,
                CROSS,
                CAMERA,
                List.of(),
                true,
                true,
                NOWHERE);
    }

    public static WorldSpec world(List<RobotSpec> robots, ObstacleSpec... obstacles) {
        return new WorldSpec("test", Path.of("test.world"), 100, robots, Arrays.asList(obstacles));
    }

    /** Every robot with all its devices, by index, on one port. */
    public static Scenario scenario(int port, WorldSpec world) {
        var devices = new ArrayList<DeviceBinding>();
        for (int index = 0; index < world.robots().size(); index++) {
            for (String type : List.of("position2d", "sonar", "blobfinder")) {
                devices.add(new DeviceBinding(
                        port, type, index, world.robots().get(index).name(), 0, NOWHERE));
            }
        }
        return new Scenario(world, devices);
    }
}
