package io.troupe.sim.scenario;

import java.util.ArrayList;
import java.util.List;

/** Which Player interfaces there are, and which of them a robot can provide. */
final class DeviceOffer {
    static final int DEFAULT_PORT = 6665;
    static final String SIMULATION = "simulation";
    private static final String POSITION = "position2d";
    private static final String SONAR = "sonar";
    private static final String BLOBFINDER = "blobfinder";
    static final List<String> INTERFACES = List.of(SIMULATION, POSITION, SONAR, BLOBFINDER);

    /** Interfaces of Player that other releases may provide. */
    static final List<String> LATER = List.of(
            "ranger",
            "laser",
            "fiducial",
            "gripper",
            "bumper",
            "ptz",
            "camera",
            "map",
            "power",
            "speech",
            "ir",
            "actarray",
            "graphics2d",
            "graphics3d",
            "localize",
            "planner",
            "log",
            "dio",
            "aio",
            "position1d",
            "position3d");

    private DeviceOffer() {}

    static List<String> of(RobotSpec robot) {
        var offer = new ArrayList<>(List.of(POSITION));
        if (robot.sonar() != null) {
            offer.add(SONAR);
        }
        if (robot.blobfinder() != null) {
            offer.add(BLOBFINDER);
        }
        return offer;
    }

    /** Everything in the world, the n-th robot's devices with index n. */
    static Scenario everything(WorldSpec world) {
        var devices = new ArrayList<DeviceBinding>();
        devices.add(new DeviceBinding(DEFAULT_PORT, SIMULATION, 0, "", 0, new SourcePosition(world.file(), 1, 1)));
        for (int index = 0; index < world.robots().size(); index++) {
            RobotSpec robot = world.robots().get(index);
            for (String interfaceName : of(robot)) {
                devices.add(new DeviceBinding(DEFAULT_PORT, interfaceName, index, robot.name(), 0, robot.where()));
            }
        }
        return new Scenario(world, devices);
    }
}
