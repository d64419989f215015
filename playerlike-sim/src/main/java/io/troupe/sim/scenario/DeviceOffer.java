package io.troupe.sim.scenario;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

/** Which Player interfaces there are, and which of them a robot can provide. */
final class DeviceOffer {
    static final int DEFAULT_PORT = 6665;
    static final String SIMULATION = "simulation";
    private static final String POSITION = "position2d";
    private static final String SONAR = "sonar";
    private static final String BLOBFINDER = "blobfinder";
    private static final String LASER = "laser";
    private static final String RANGER = "ranger";
    static final List<String> INTERFACES = List.of(SIMULATION, POSITION, SONAR, LASER, RANGER, BLOBFINDER);

    /** Interfaces of Player that other releases may provide. */
    static final List<String> LATER = List.of(
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

    /** The interfaces of a robot's devices, one for each device. */
    static List<String> of(RobotSpec robot) {
        var offer = new ArrayList<>(List.of(POSITION));
        if (robot.sonar() != null) {
            offer.add(SONAR);
        }
        robot.rangers().forEach(ranger -> offer.add(interfaceOf(ranger)));
        if (robot.blobfinder() != null) {
            offer.add(BLOBFINDER);
        }
        return offer;
    }

    /**
     * What a configuration may provide: on top of {@link #of} one ring of sonars by both of its interfaces, as programs
     * for both dialects expect them.
     */
    static List<String> ofConfiguration(RobotSpec robot) {
        var offer = new ArrayList<>(of(robot));
        if (robot.sonar() != null) {
            offer.add(RANGER);
        } else if (ringOf(robot) >= 0) {
            offer.add(SONAR);
        }
        return offer;
    }

    /** The ranger that can stand for a ring of sonars: one range for each place; -1 if there is none. */
    private static int ringOf(RobotSpec robot) {
        for (int i = 0; i < robot.rangers().size(); i++) {
            RangerSpec ranger = robot.rangers().get(i);
            if (ranger.kind() == RangerSpec.Kind.RANGER
                    && ranger.sensors().stream().allMatch(sensor -> sensor.samples() == 1)) {
                return i;
            }
        }
        return -1;
    }

    private static String interfaceOf(RangerSpec ranger) {
        return switch (ranger.kind()) {
            case LASER -> LASER;
            case RANGER -> RANGER;
        };
    }

    /** Which of the robot's rangers is its n-th device of an interface, as {@link DeviceBinding#ranger} has it. */
    static int rangerOf(RobotSpec robot, String interfaceName, int nth) {
        if (interfaceName.equals(SONAR)) {
            return robot.sonar() == null ? Math.max(0, ringOf(robot)) : 0;
        }
        int left = nth;
        for (int i = 0; i < robot.rangers().size(); i++) {
            if (interfaceOf(robot.rangers().get(i)).equals(interfaceName) && left-- == 0) {
                return i;
            }
        }
        return interfaceName.equals(RANGER) ? DeviceBinding.SONAR_RING : 0; // after the rangers
    }

    /** Everything in the world, as {@link ScenarioReader#read(java.nio.file.Path)} describes it. */
    static Scenario everything(WorldSpec world) {
        var devices = new ArrayList<DeviceBinding>();
        devices.add(new DeviceBinding(DEFAULT_PORT, SIMULATION, 0, "", 0, new SourcePosition(world.file(), 1, 1)));
        Map<String, Integer> further = new TreeMap<>();
        for (int robotIndex = 0; robotIndex < world.robots().size(); robotIndex++) {
            RobotSpec robot = world.robots().get(robotIndex);
            Map<String, Integer> taken = new TreeMap<>();
            for (String interfaceName : of(robot)) {
                int nth = taken.merge(interfaceName, 1, Integer::sum) - 1;
                int index = nth == 0
                        ? robotIndex
                        : world.robots().size() + further.merge(interfaceName, 1, Integer::sum) - 1;
                int ranger = rangerOf(robot, interfaceName, nth);
                devices.add(new DeviceBinding(DEFAULT_PORT, interfaceName, index, robot.name(), ranger, robot.where()));
            }
        }
        return new Scenario(world, devices);
    }
}
