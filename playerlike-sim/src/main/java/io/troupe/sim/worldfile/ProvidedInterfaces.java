package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.WorldSpec;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

/** The Player interfaces that exist, and those that a robot can provide. */
final class ProvidedInterfaces {
    static final int DEFAULT_PORT = 6665;
    static final String SIMULATION = "simulation";
    private static final String POSITION = "position2d";
    static final String SONAR = "sonar";
    private static final String BLOBFINDER = "blobfinder";
    static final String LASER = "laser";
    static final String RANGER = "ranger";
    static final List<String> INTERFACES =
            List.of(SIMULATION, POSITION, SONAR, LASER, RANGER, BLOBFINDER, "fiducial", "bumper", "camera", "gripper");

    /** Player interfaces that are known and not provided here. */
    static final List<String> LATER = List.of(
            "ptz",
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

    private ProvidedInterfaces() {}

    /** The interfaces of a robot's devices, one entry per device. */
    static List<String> of(RobotSpec robot) {
        var offer = new ArrayList<>(List.of(POSITION));
        if (robot.sonar() != null) {
            offer.add(SONAR);
        }
        robot.rangers().forEach(ranger -> offer.add(interfaceOf(ranger)));
        if (robot.blobfinder() != null) {
            offer.add(BLOBFINDER);
        }
        robot.devices().forEach(device -> offer.add(device.interfaceName()));
        return offer;
    }

    /**
     * The interfaces that a configuration may provide: those of {@link #of}, and the sonar ring by both of its
     * interfaces, as programs for both dialects expect.
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

    /**
     * Index of the ranger that can replace a sonar ring, because each of its sensors has one ray; -1 if there is none.
     */
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

    static final int NO_SUCH = -2;

    /**
     * The value of {@link DeviceBinding#ranger} for a device that is offered by another interface, too;
     * {@link #NO_SUCH} for a laser of several sensors.
     */
    static int renamed(RobotSpec robot, DeviceBinding device, String otherInterface) {
        if (device.interfaceName().equals(SONAR)) {
            return robot.sonar() == null ? device.ranger() : DeviceBinding.SONAR_RING;
        }
        boolean oneSensor = device.ranger() >= 0
                && robot.rangers().get(device.ranger()).sensors().size() == 1;
        return otherInterface.equals(LASER) && !oneSensor ? NO_SUCH : device.ranger();
    }

    private static String interfaceOf(RangerSpec ranger) {
        return switch (ranger.kind()) {
            case LASER -> LASER;
            case RANGER -> RANGER;
        };
    }

    /** The value of {@link DeviceBinding#ranger} for a robot's n-th device of an interface. */
    static int rangerOf(RobotSpec robot, String interfaceName, int nth) {
        if (interfaceName.equals(SONAR)) {
            return robot.sonar() == null ? Math.max(0, ringOf(robot)) : 0;
        }
        int left = nth;
        for (int i = 0; i < robot.devices().size(); i++) {
            if (robot.devices().get(i).interfaceName().equals(interfaceName) && left-- == 0) {
                return i;
            }
        }
        for (int i = 0; i < robot.rangers().size(); i++) {
            if (interfaceOf(robot.rangers().get(i)).equals(interfaceName) && left-- == 0) {
                return i;
            }
        }
        return interfaceName.equals(RANGER) ? DeviceBinding.SONAR_RING : 0; // the ring comes after the rangers
    }

    /** Binds all devices of the world, as {@link ScenarioReader#read(java.nio.file.Path)} describes. */
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
