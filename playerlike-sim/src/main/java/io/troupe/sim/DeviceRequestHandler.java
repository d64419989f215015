package io.troupe.sim;

import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.Interfaces;
import io.troupe.player.wire.LaserConfiguration;
import io.troupe.player.wire.Octets;
import io.troupe.player.wire.Pose3d;
import io.troupe.sim.ClientCommands.Kind;
import io.troupe.sim.PortServer.PortDevice;
import io.troupe.sim.device.GripperDevice;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.RobotSpec;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.util.Arrays;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;
import java.util.Set;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * Handles the commands and requests that a client sends to the simulated devices. Changes of the world are deferred to
 * the end of the tick. {@code Pause} takes effect at once, because a paused world has no ticks.
 *
 * <p><b>Threads.</b> Any thread; guarded by the simulation's lock.
 *
 * <p><b>Source.</b> What Stage acknowledges, refuses and ignores.
 */
final class DeviceRequestHandler {
    /** Queues an action for the end of the tick. */
    interface CommandQueue {
        void add(PortDevice device, Kind kind, Runnable action);
    }

    private static final DeviceReply ACK = new DeviceReply.Ack();
    private static final DeviceReply NOT_OFFERED =
            new DeviceReply.Nack("the simulator does not offer that for this device");
    private static final DeviceReply AS_IN_THE_FILE =
            new DeviceReply.Nack("the configuration of a simulated device is that of its world file");

    private final Simulation simulation;
    private final World world;
    private final CommandQueue queue;
    /** The rangers whose intensities the client wants as messages. */
    private final Set<PortDevice> wantIntensities = new HashSet<>();

    /** Time in microseconds for which the client's speed commands hold, for each device with a limit set. */
    private final Map<PortDevice, Long> commandLimitsMicros = new HashMap<>();

    DeviceRequestHandler(Simulation simulation, CommandQueue queue) {
        this.simulation = simulation;
        this.world = simulation.world();
        this.queue = queue;
    }

    void command(PortDevice device, DeviceCommand command) {
        switch (device.type()) {
            case POSITION2D -> drive(device, command);
            case SIMULATION -> simulate(device, command);
            case GRIPPER -> grip(device, command);
            case SONAR, RANGER, LASER, BLOBFINDER, FIDUCIAL, BUMPER, CAMERA ->
                throw new IllegalArgumentException(device + " takes no commands");
        }
    }

    /**
     * Handles a motion command. Speeds sideways move omnidirectional robots only. The byte {@code state} is ignored as
     * in Stage: a command with state 0 also drives.
     */
    private void drive(PortDevice device, DeviceCommand command) {
        int robot = device.robot();
        long limitMicros = commandLimitsMicros.getOrDefault(device, 0L);
        Runnable action = switch (command) {
            case DeviceCommand.Velocity to -> {
                checkFinite(device, to, to.vx(), to.vy(), to.va());
                yield () -> world.commandFor(limitMicros, robot, to.vx(), to.vy(), to.va());
            }
            case DeviceCommand.Car to -> {
                checkFinite(device, to, to.velocityMps(), to.angleRad());
                yield () -> world.commandFor(limitMicros, robot, to.velocityMps(), 0, to.angleRad());
            }
            case DeviceCommand.VelocityHeading to -> {
                checkFinite(device, to, to.velocityMps(), to.headingRad());
                yield () -> world.steer(robot, to.velocityMps(), to.headingRad(), limitMicros);
            }
            case DeviceCommand.GoTo to -> {
                checkFinite(device, to, to.px(), to.py(), to.pa());
                yield () -> world.goTo(robot, new Pose(to.px(), to.py(), to.pa()));
            }
            case DeviceCommand.Pause other -> throw notUnderstood(device, other);
            case DeviceCommand.Reset other -> throw notUnderstood(device, other);
            case DeviceCommand.Save other -> throw notUnderstood(device, other);
            case DeviceCommand.Gripper other -> throw notUnderstood(device, other);
        };
        queue.add(device, Kind.SPEED, action);
    }

    private void simulate(PortDevice device, DeviceCommand command) {
        switch (command) {
            case DeviceCommand.Pause pause -> simulation.togglePause(this);
            case DeviceCommand.Reset reset -> queue.add(device, Kind.RESET, simulation::reset);
            case DeviceCommand.Save save ->
                System.getLogger(Simulation.class.getName())
                        .log(System.Logger.Level.WARNING, "a client asked to save the world, which is not offered");
            case DeviceCommand.Velocity other -> throw notUnderstood(device, other);
            case DeviceCommand.Car other -> throw notUnderstood(device, other);
            case DeviceCommand.VelocityHeading other -> throw notUnderstood(device, other);
            case DeviceCommand.GoTo other -> throw notUnderstood(device, other);
            case DeviceCommand.Gripper other -> throw notUnderstood(device, other);
        }
    }

    /** As with Stage, a gripper opens and closes; it neither stops on the way nor stores anything. */
    private void grip(PortDevice device, DeviceCommand command) {
        if (!(command instanceof DeviceCommand.Gripper(int order))) {
            throw notUnderstood(device, command);
        }
        switch (order) {
            case DeviceCommand.Gripper.OPEN -> grip(device, GripperDevice.Order.OPEN);
            case DeviceCommand.Gripper.CLOSE -> grip(device, GripperDevice.Order.CLOSE);
            default ->
                System.getLogger(Simulation.class.getName())
                        .log(
                                System.Logger.Level.WARNING,
                                "{0} was sent command {1}, and only opens (1) and closes (2)",
                                device,
                                order);
        }
    }

    private void grip(PortDevice device, GripperDevice.Order order) {
        queue.add(device, Kind.GRIPPER, () -> world.grip(device.robot(), device.ranger(), order));
    }

    private static IllegalArgumentException notUnderstood(PortDevice device, DeviceCommand command) {
        return new IllegalArgumentException(device + " does not understand " + command);
    }

    private static void checkFinite(PortDevice device, DeviceCommand command, double... numbers) {
        for (double number : numbers) {
            if (!Double.isFinite(number)) {
                throw new IllegalArgumentException(device + " received " + command + ", expected finite numbers");
            }
        }
    }

    DeviceReply request(PortDevice device, DeviceRequest request) {
        if (request instanceof DeviceRequest.Capability asked) {
            return Capabilities.understands(device.type(), asked.type(), asked.subtype()) ? ACK : NOT_OFFERED;
        }
        return switch (device.type()) {
            case POSITION2D -> ofPosition(device, request);
            case SONAR ->
                switch (request) {
                    case DeviceRequest.Geometry geometry ->
                        DeviceConversion.sonarGeometry(robot(device), device.ranger());
                    case DeviceRequest.Power power -> sensorPower(device, power.on());
                    default -> NOT_OFFERED;
                };
            case LASER -> ofLaser(device, robot(device).rangers().get(device.ranger()), request);
            case RANGER -> ofRanger(device, ranger(device), request);
            case BLOBFINDER -> NOT_OFFERED;
            case FIDUCIAL, BUMPER, CAMERA, GRIPPER ->
                FurtherDevices.request(
                        robot(device),
                        robot(device).devices().get(device.ranger()),
                        world.latest().robots().get(device.robot()).devices().get(device.ranger()),
                        request);
            case SIMULATION -> ofSimulation(device, request);
        };
    }

    private RobotSpec robot(PortDevice device) {
        return world.spec().robots().get(device.robot());
    }

    private RangerSpec ranger(PortDevice device) {
        RobotSpec robot = robot(device);
        return DeviceConversion.isRing(device.type(), device.ranger())
                ? RangerConversion.ring(Objects.requireNonNull(robot.sonar()))
                : robot.rangers().get(device.ranger());
    }

    private DeviceReply ofPosition(PortDevice device, DeviceRequest request) {
        return switch (request) {
            case DeviceRequest.Geometry geometry -> DeviceConversion.positionGeometry(robot(device));
            case DeviceRequest.ResetOdometry reset -> odometry(device, Pose.ORIGIN);
            case DeviceRequest.SetOdometry set -> odometry(device, new Pose(set.px(), set.py(), set.pa()));
            case DeviceRequest.Power power -> {
                queue.add(device, Kind.POWER, () -> world.motorPower(device.robot(), power.on()));
                yield ACK;
            }
            // ignored: the type of each command determines its mode
            case DeviceRequest.PositionMode mode ->
                mode.mode() == 0 || mode.mode() == 1
                        ? ACK
                        : new DeviceReply.Nack(
                                "position mode is " + mode.mode() + ", expected 0 (velocity) or 1 (position)");
            case DeviceRequest.SetIntegerProperty set -> property(device, set);
            default -> NOT_OFFERED;
        };
    }

    /**
     * Sets the time for which later commands hold. The limit belongs to the client and not to the world, so a reset of
     * the world keeps it. The limit of their age is up to the server that the client is connected to by a socket: a
     * command that is sent here is never late.
     */
    private DeviceReply property(PortDevice device, DeviceRequest.SetIntegerProperty set) {
        boolean isLimit = set.key().equals(DeviceRequest.COMMAND_LIMIT_KEY);
        if (!isLimit && !set.key().equals(DeviceRequest.COMMAND_AGE_KEY)) {
            return new DeviceReply.Nack("there is no property '" + set.key() + "', expected "
                    + DeviceRequest.COMMAND_LIMIT_KEY + " or " + DeviceRequest.COMMAND_AGE_KEY);
        }
        if (set.value() < 0) {
            return new DeviceReply.Nack(set.key() + " is " + set.value() + ", expected 0 (no limit) or more");
        }
        if (isLimit) {
            commandLimitsMicros.put(device, set.value() * 1000L);
        }
        return ACK;
    }

    private DeviceReply odometry(PortDevice device, Pose pose) {
        String refusal = world.odometryRefusal(device.robot(), pose);
        if (refusal != null) {
            return new DeviceReply.Nack(refusal);
        }
        queue.add(device, Kind.ODOMETRY, () -> world.setOdometry(device.robot(), pose));
        return ACK;
    }

    /**
     * Refuses to switch a sensor off, as Stage does. In lock step a client without data has nothing to answer, and
     * other clients may rely on the sensor's data.
     */
    private static DeviceReply sensorPower(PortDevice device, boolean on) {
        return on ? ACK : new DeviceReply.Nack(device + " of a simulated robot cannot be switched off");
    }

    private DeviceReply ofLaser(PortDevice device, RangerSpec laser, DeviceRequest request) {
        var configuration =
                RangerConversion.laserConfiguration(laser, world.spec().intervalMillis(), measuresIntensities(device));
        return switch (request) {
            case DeviceRequest.Geometry geometry -> RangerConversion.laserGeometry(laser);
            case DeviceRequest.GetConfiguration get -> new DeviceReply.OfLaser(configuration);
            case DeviceRequest.SetLaserConfiguration(LaserConfiguration asked) -> {
                if (!RangerConversion.isSame(asked, configuration)) {
                    yield AS_IN_THE_FILE;
                }
                if (asked.intensities() != configuration.intensities()) {
                    switchIntensities(device, asked.intensities());
                }
                yield new DeviceReply.OfLaser(configuration.withIntensities(asked.intensities()));
            }
            case DeviceRequest.Power power -> sensorPower(device, power.on());
            case DeviceRequest.LaserId id ->
                new DeviceReply.LaserId(device.address().index());
            default -> NOT_OFFERED;
        };
    }

    private DeviceReply ofRanger(PortDevice device, RangerSpec ranger, DeviceRequest request) {
        var configuration =
                RangerConversion.rangerConfiguration(ranger, world.spec().intervalMillis());
        return switch (request) {
            case DeviceRequest.Geometry geometry -> RangerConversion.rangerGeometry(ranger);
            case DeviceRequest.GetConfiguration get -> new DeviceReply.OfRanger(configuration);
            case DeviceRequest.SetRangerConfiguration set ->
                set.configuration().equals(configuration) ? new DeviceReply.OfRanger(configuration) : AS_IN_THE_FILE;
            case DeviceRequest.Power power -> sensorPower(device, power.on());
            case DeviceRequest.Intensities(boolean on) -> {
                if (!on) {
                    wantIntensities.remove(device); // other clients may still want them
                } else if (DeviceConversion.isRing(device.type(), device.ranger())) {
                    yield NOT_OFFERED;
                } else if (wantIntensities.add(device)) {
                    switchIntensities(device, true);
                }
                yield ACK;
            }
            default -> NOT_OFFERED;
        };
    }

    private void switchIntensities(PortDevice device, boolean on) {
        queue.add(device, Kind.INTENSITIES, () -> world.measureIntensities(device.robot(), device.ranger(), on));
    }

    private boolean measuresIntensities(PortDevice device) {
        return !DeviceConversion.intensities(device, world.latest()).isEmpty();
    }

    /** True if the client has asked for messages with the intensities of a ranger. */
    boolean wantsIntensities(PortDevice device) {
        return wantIntensities.contains(device);
    }

    private DeviceReply ofSimulation(PortDevice device, DeviceRequest request) {
        return switch (request) {
            case DeviceRequest.GetPose get -> {
                Pose pose = poseOf(get.model());
                yield pose == null
                        ? noModel(get.model())
                        : new DeviceReply.ModelPose(get.model(), pose.x(), pose.y(), pose.headingRad());
            }
            case DeviceRequest.SetPose set -> teleport(device, set.model(), new Pose(set.px(), set.py(), set.pa()));
            case DeviceRequest.GetPose3d get -> {
                Pose pose = poseOf(get.model());
                yield pose == null
                        ? noModel(get.model())
                        : new DeviceReply.ModelPose3d(
                                get.model(), Pose3d.flat(pose.x(), pose.y(), pose.headingRad()), world.timeMicros());
            }
            case DeviceRequest.SetPose3d(String model, Pose3d pose, double time) ->
                pose.z() == 0 && pose.roll() == 0 && pose.pitch() == 0
                        ? teleport(device, model, new Pose(pose.x(), pose.y(), pose.yaw()))
                        : new DeviceReply.Nack("'" + model + "' was to be put at z " + pose.z() + ", roll "
                                + pose.roll() + " and pitch " + pose.pitch() + ", expected 0: the world is flat");
            case DeviceRequest.GetProperty get -> ofModel(get);
            default -> NOT_OFFERED;
        };
    }

    private DeviceReply noModel(String model) {
        return new DeviceReply.Nack("world '" + world.spec().name() + "' has no model '" + model + "'");
    }

    private @Nullable Pose poseOf(String model) {
        int robot = world.robotNumber(model);
        if (robot >= 0) {
            return world.latest().robots().get(robot).pose();
        }
        int obstacle = obstacle(model);
        return obstacle < 0
                ? null
                : world.latest()
                        .displaced(world.spec())
                        .getOrDefault(
                                obstacle,
                                Optional.of(
                                        world.spec().obstacles().get(obstacle).pose()))
                        .orElse(null);
    }

    /** Index of the first obstacle with a name, or -1. */
    private int obstacle(String model) {
        List<ObstacleSpec> obstacles = world.spec().obstacles();
        return IntStream.range(0, obstacles.size())
                .filter(i -> obstacles.get(i).name().equals(model))
                .findFirst()
                .orElse(-1);
    }

    /**
     * The property {@code color}, four floats (red, green, blue, opacity) from 0 to 1, or {@code time}, simulated time
     * in microseconds. As in Stage the request has the length of the value, and its bytes are those of the memory of a
     * usual machine: the least first.
     */
    private DeviceReply ofModel(DeviceRequest.GetProperty get) {
        if (poseOf(get.model()) == null) {
            return noModel(get.model());
        }
        ByteBuffer value = ByteBuffer.allocate(16).order(ByteOrder.LITTLE_ENDIAN);
        switch (get.property()) {
            case "color" -> {
                int colour = colourOf(get.model());
                for (int shift = 16; shift >= 0; shift -= 8) {
                    value.putFloat((colour >> shift & 0xFF) / 255f);
                }
                value.putFloat(1);
            }
            case "time" -> value.putLong(world.timeMicros());
            default -> {
                return new DeviceReply.Nack(
                        "there is no property '" + get.property() + "' of a model, expected color or time");
            }
        }
        byte[] bytes = Arrays.copyOf(value.array(), value.position());
        if (get.valueBytes() != bytes.length) {
            return new DeviceReply.Nack("property '" + get.property() + "' has " + bytes.length
                    + " bytes, and the request has room for " + get.valueBytes());
        }
        return new DeviceReply.ModelProperty(get.model(), get.property(), get.index(), Octets.of(bytes));
    }

    private int colourOf(String model) {
        int robot = world.robotNumber(model);
        if (robot >= 0) {
            return world.spec().robots().get(robot).colour();
        }
        return world.spec().obstacles().get(obstacle(model)).colour();
    }

    private DeviceReply teleport(PortDevice device, String model, Pose pose) {
        int robot = world.robotNumber(model);
        int obstacle = robot >= 0 ? -1 : obstacle(model);
        if (robot < 0 && obstacle < 0) {
            return noModel(model);
        }
        String refusal = robot >= 0 ? world.teleportRefusal(robot, pose) : world.obstacleRefusal(obstacle, pose);
        if (refusal != null) {
            return new DeviceReply.Nack(refusal);
        }
        // one address per model, so that only the newest place of each counts
        int number = robot >= 0 ? robot : world.spec().robots().size() + obstacle;
        var itself = new PortDevice(device.address(), Interfaces.SIMULATION, number, 0);
        queue.add(
                itself,
                Kind.PLACE,
                robot >= 0 ? () -> world.teleportLater(robot, pose) : () -> world.placeObstacleLater(obstacle, pose));
        return ACK;
    }

    /** The messages that the simulated devices understand, as Player's type and subtype numbers. */
    private static final class Capabilities {
        private static final int DATA = 1;
        private static final int COMMAND = 2;
        private static final int REQUEST = 3;
        /** Subtype of the capability request itself. */
        private static final int CAPABILITY = 255;

        private Capabilities() {}

        static boolean understands(Interfaces device, int type, int subtype) {
            return type == REQUEST && subtype == CAPABILITY
                    || subtypes(device, type).contains(subtype);
        }

        private static List<Integer> subtypes(Interfaces device, int type) {
            return switch (type) {
                case DATA ->
                    switch (device) {
                        case SIMULATION -> List.of();
                        case RANGER -> List.of(1, 3);
                        default -> List.of(1);
                    };
                case COMMAND ->
                    switch (device) {
                        case POSITION2D -> List.of(1, 2, 3, 4);
                        case SIMULATION -> List.of(1, 2);
                        case SONAR, RANGER, LASER, BLOBFINDER, FIDUCIAL, BUMPER, CAMERA -> List.of();
                        case GRIPPER -> List.of(1, 2);
                    };
                case REQUEST ->
                    switch (device) {
                        case POSITION2D -> List.of(1, 2, 4, 5, 6, 253);
                        case SONAR -> List.of(1, 2);
                        case SIMULATION -> List.of(1, 2, 3, 4, 5);
                        case RANGER -> List.of(1, 2, 3, 4, 5);
                        case LASER -> List.of(1, 2, 3, 4, 5);
                        case BLOBFINDER -> List.of();
                        case CAMERA -> List.of(3);
                        case FIDUCIAL -> List.of(1, 2, 3, 7, 8);
                        case BUMPER, GRIPPER -> List.of(1);
                    };
                default -> List.of();
            };
        }
    }
}
