package io.troupe.sim;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.model.WorldSpec;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;

/** Small worlds built in code, and the devices that they provide. */
public final class TestWorlds {
    public static final int BLACK = Specs.BLACK;
    public static final int RED = Specs.RED;
    public static final int GREEN = Specs.GREEN;
    public static final SourcePosition NOWHERE = Specs.at(1);
    /** Facing left, ahead, right and back; at the centre of rotation. */
    public static final SonarSpec CROSS = Specs.sonars(90, 0, -90, 180);
    /** 80 columns of one degree, 5 m. */
    public static final BlobfinderSpec CAMERA =
            new BlobfinderSpec(Pose.ORIGIN, 80, 60, 5, StrictMath.toRadians(80), List.of());

    private TestWorlds() {}

    public static ObstacleSpec wall(String name, double x, double y, double lengthM, double widthM, int colour) {
        return Specs.box(name, new Pose(x, y, 0), lengthM, widthM, colour);
    }

    /** 0.4 m by 0.3 m, with the sonar cross and the camera. */
    public static RobotSpec robot(String name, double x, double y, double headingRad) {
        Pose pose = new Pose(x, y, headingRad);
        Pose zero = Pose.ORIGIN;
        Shape box = Specs.box(0.4, 0.3);
        List<RangerSpec> none = List.of();
        return new RobotSpec(
                name, pose, box, Specs.ORANGE, 0.4, 0.3, 10, zero, zero, CROSS, CAMERA, none, true, true, NOWHERE);
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
