package io.troupe.sim;

import io.troupe.sim.device.GripperDevice;
import io.troupe.sim.device.Position2d;
import io.troupe.sim.device.Ranger;
import io.troupe.sim.device.Scene;
import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.DeviceSpec;
import io.troupe.sim.model.DriveSpec.Steering;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.physics.Physics;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.Queue;
import java.util.SortedMap;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/**
 * Commands for the robots of a world, buffered until the next interval begins, and the recording of them.
 *
 * <p><b>Threads.</b> Any thread may send commands. {@link #takeReset} and {@link #apply} belong to the thread that
 * advances the world.
 *
 * <p>Long, because every kind of command is checked, kept, applied in a fixed order and recorded here.
 */
final class WorldCommands {
    /** Occupancy at the snapshot of the newest teleport check. */
    private record TeleportCheck(Snapshot at, PlacementCheck.Occupancy occupancy) {}

    private final WorldSpec spec;
    private final WorldSettings settings;
    private final List<Integer> movers; // indices of the obstacles that may move
    private final WorldContents contents;
    private volatile PlacementCheck placement;
    private final AtomicReference<@Nullable TeleportCheck> lastCheck = new AtomicReference<>();
    private final List<RobotCommands> robotCommands = new ArrayList<>();
    private final AtomicBoolean resetWanted = new AtomicBoolean();
    private final AtomicReference<@Nullable Recording> recording = new AtomicReference<>();
    private final Queue<DeviceCommand> deviceCommands = new ConcurrentLinkedQueue<>();

    /** A command for a device other than the drive. */
    private sealed interface DeviceCommand {
        record Intensities(int robot, int ranger, boolean on) implements DeviceCommand {}

        record Grip(int robot, int device, GripperDevice.Order order) implements DeviceCommand {}
    }

    WorldCommands(WorldSpec spec, WorldSettings settings) {
        this.spec = spec;
        this.settings = settings;
        movers = spec.movingObstacles();
        contents = new WorldContents(spec);
        placement = contents.placement();
        for (int i = 0; i < spec.robots().size(); i++) {
            robotCommands.add(
                    new RobotCommands(spec.robots().get(i).drive(), i, settings, spec.intervalMillis() / 1000.0));
        }
    }

    // ---- from any thread

    /** @param limitMicros time for which the command holds; 0 = until another command */
    void drive(int robot, double forwardMps, double sidewaysMps, double turnRadps, long limitMicros) {
        check(robot, forwardMps, turnRadps);
        if (!Double.isFinite(sidewaysMps)) {
            throw new IllegalArgumentException("robot '" + robot(robot).name() + "' was commanded to drive sideways at "
                    + sidewaysMps + " m/s, expected a finite number");
        }
        boolean sideways = robot(robot).drive().steering() instanceof Steering.Omnidirectional;
        robotCommands
                .get(robot)
                .drive(new MotionCommand.Velocity(forwardMps, sideways ? sidewaysMps : 0, turnRadps), limitMicros);
    }

    /** Speed command from the thread that advances the world; replaces all commands sent so far by other threads. */
    void driveNow(int robot, double forwardMps, double turnRadps) {
        check(robot, forwardMps, turnRadps);
        robotCommands.get(robot).driveNow(forwardMps, turnRadps);
    }

    private void check(int robot, double forwardMps, double turnRadps) {
        RobotSpec target = robot(robot);
        if (!Double.isFinite(forwardMps) || !Double.isFinite(turnRadps)) {
            throw new IllegalArgumentException("robot '" + target.name() + "' was commanded to drive at " + forwardMps
                    + " m/s and " + turnRadps + " rad/s, expected finite numbers");
        }
    }

    /** @param limitMicros time for which the command holds; 0 = until another command */
    void steer(int robot, double forwardMps, double headingRad, long limitMicros) {
        RobotSpec target = robot(robot);
        checkTurns(target, "steered to a heading");
        if (!Double.isFinite(forwardMps) || !Double.isFinite(headingRad)) {
            throw new IllegalArgumentException("robot '" + target.name() + "' was commanded to drive at " + forwardMps
                    + " m/s to a heading of " + headingRad + " rad, expected finite numbers");
        }
        robotCommands.get(robot).drive(new MotionCommand.Heading(forwardMps, headingRad), limitMicros);
    }

    void goTo(int robot, Pose goal) {
        RobotSpec target = robot(robot);
        checkTurns(target, "sent to a pose");
        if (!isFinite(goal)) {
            throw new IllegalArgumentException(
                    "robot '" + target.name() + "' was commanded to go to " + goal + ", expected finite numbers");
        }
        robotCommands.get(robot).drive(new MotionCommand.GoTo(goal), 0);
    }

    /** Position control turns on the spot, which a car cannot. */
    private static void checkTurns(RobotSpec robot, String what) {
        if (robot.drive().steering() instanceof Steering.Car) {
            throw new IllegalArgumentException("robot '" + robot.name() + "' steers like a car and cannot be " + what
                    + ": command its speed and steering angle");
        }
    }

    /** Whether a laser or ranger measures intensities. */
    void measureIntensities(int robot, int ranger, boolean on) {
        int count = robot(robot).rangers().size();
        if (ranger < 0 || ranger >= count) {
            throw new IllegalArgumentException("robot '" + robot(robot).name() + "' has no laser or ranger " + ranger
                    + ", but " + count + " of them, counted from 0");
        }
        deviceCommands.add(new DeviceCommand.Intensities(robot, ranger, on));
    }

    /** Opens or closes a gripper. */
    void grip(int robot, int device, GripperDevice.Order order) {
        List<DeviceSpec> devices = robot(robot).devices();
        if (device < 0 || device >= devices.size() || !(devices.get(device) instanceof DeviceSpec.Gripper)) {
            throw new IllegalArgumentException(
                    "device " + device + " of robot '" + robot(robot).name()
                            + "' is no gripper; its devices, counted from 0, are "
                            + devices.stream().map(DeviceSpec::interfaceName).toList());
        }
        deviceCommands.add(new DeviceCommand.Grip(robot, device, order));
    }

    void power(int robot, boolean on) {
        robot(robot);
        robotCommands.get(robot).power(on);
    }

    void odometry(int robot, Pose pose) {
        String refusal = odometryRefusal(robot, pose);
        if (refusal != null) {
            throw new IllegalArgumentException(refusal);
        }
        robotCommands.get(robot).odometry(pose);
    }

    /** Reason why a robot's odometry cannot be set to a pose, or null. */
    @Nullable
    String odometryRefusal(int robot, Pose pose) {
        RobotSpec target = robot(robot);
        return Position2d.canReport(pose)
                ? null
                : "odometry of robot '" + target.name() + "' was set to " + pose
                        + ", expected finite numbers of at most " + Position2d.FARTHEST;
    }

    /** Queues a teleport that is checked only when it takes effect. */
    void teleport(int robot, Pose pose) {
        robot(robot);
        robotCommands.get(robot).teleport(pose);
    }

    /** Queues taking a robot out of the world. */
    void removeRobot(int robot) {
        robot(robot);
        robotCommands.get(robot).remove();
    }

    /** Queues taking an obstacle away. */
    void removeObstacle(int obstacle) {
        contents.demand(obstacle, null);
    }

    /** Queues putting an obstacle at a pose, which is checked only when it takes effect. */
    void placeObstacle(int obstacle, Pose pose) {
        contents.demand(obstacle, pose);
    }

    /** Reason why an obstacle could not be put at a pose in the world of a snapshot, or null. */
    @Nullable
    String obstacleRefusal(int obstacle, Pose pose, Snapshot at) {
        contents.checkObstacle(obstacle);
        return occupancy(at).refusal(spec.obstacles().get(obstacle), movers.indexOf(obstacle), pose);
    }

    /** Reason why a box could not be put where it is in the world of a snapshot, or null. */
    @Nullable
    String boxRefusal(ColouredBox box, Snapshot at) {
        return refusal(box, occupancy(at));
    }

    /** Reason why a box cannot be put where it is now, or null. */
    @Nullable
    String boxRefusal(ColouredBox box, Physics physics) {
        return refusal(box, placement.occupancy(physics::pose));
    }

    private static @Nullable String refusal(ColouredBox box, PlacementCheck.Occupancy occupancy) {
        return occupancy.refusal(
                box.obstacle(), PlacementCheck.NOT_A_MOVER, box.obstacle().pose());
    }

    /** Reason why a robot could not be placed at a pose in the world of a snapshot, or null. */
    @Nullable
    String teleportRefusal(int robot, Pose pose, Snapshot at) {
        robot(robot);
        return occupancy(at).refusal(robot, pose);
    }

    private PlacementCheck.Occupancy occupancy(Snapshot at) {
        TeleportCheck known = lastCheck.get();
        if (known == null || known.at() != at) {
            known = new TeleportCheck(at, placement.occupancy(body -> pose(at, body)));
            lastCheck.set(known);
        }
        return known.occupancy();
    }

    /** Pose of a robot or, after the robots, of an obstacle that moves. */
    private static Pose pose(Snapshot at, int body) {
        int robotCount = at.robots().size();
        return body < robotCount ? at.robots().get(body).pose() : at.moved().get(body - robotCount);
    }

    /** Requests a reset. Commands sent from now on apply after it. */
    void reset() {
        robotCommands.forEach(RobotCommands::forgetUntaken);
        contents.forgetDemands();
        deviceCommands.clear();
        resetWanted.set(true);
    }

    private static boolean isFinite(Pose pose) {
        return Double.isFinite(pose.x()) && Double.isFinite(pose.y()) && Double.isFinite(pose.headingRad());
    }

    private RobotSpec robot(int robot) {
        List<RobotSpec> robots = spec.robots();
        if (robot < 0 || robot >= robots.size()) {
            throw new IllegalArgumentException("there is no robot " + robot + ", world '" + spec.name() + "' has "
                    + robots.size() + ", counted from 0");
        }
        return robots.get(robot);
    }

    // ---- the recording

    Recording record(Appendable out, Snapshot latest) {
        if (latest.tick() != 0) {
            throw new IllegalStateException("a recording begins at tick 0, the world is at tick " + latest.tick());
        }
        var begun = new Recording(out, spec, settings, latest);
        if (!recording.compareAndSet(null, begun)) {
            throw new IllegalStateException("the world is being recorded already");
        }
        return begun;
    }

    @Nullable
    Recording recording() {
        return recording.get();
    }

    // ---- from the thread that advances the world

    /** True if a reset was requested; it discards all commands taken so far. */
    boolean takeReset(long nowMicros) {
        if (!resetWanted.get() || !resetWanted.getAndSet(false)) {
            return false;
        }
        Recording log = recording.get();
        if (log != null) {
            log.reset();
        }
        robotCommands.forEach(commands -> commands.forget(nowMicros));
        return true;
    }

    /** Which robots and obstacles are in the world. */
    WorldContents contents() {
        return contents;
    }

    /** After a reset everything is there as at the start. Returns whether something was not. */
    boolean returnToStart() {
        boolean changed = contents.begin();
        if (changed) {
            placement = contents.placement();
        }
        return changed;
    }

    /** Puts these boxes into the world, instead of those that are there. */
    WorldContents furnish(List<ColouredBox> boxes) {
        contents.furnish(boxes);
        placement = contents.placement();
        lastCheck.set(null);
        return contents;
    }

    /**
     * Takes what leaves, then obstacles that are put somewhere, teleports, and odometry, motor power and commands, each
     * by index. Allocates nothing unless another thread has sent a command.
     *
     * @return whether a robot or an obstacle has come, gone or moved by itself, so that the scene is another one
     */
    boolean apply(
            long tick,
            long nowMicros,
            Physics physics,
            List<SimulatedDevices> devices,
            Scene scene,
            Grippers grippers) {
        Recording log = recording.get();
        boolean changed = applyPresence(tick, physics, grippers);
        PlacementCheck.Occupancy occupancy = null;
        boolean returned = false;
        for (int i = 0; i < robotCommands.size(); i++) {
            Pose place = robotCommands.get(i).takeTeleport();
            if (place != null) {
                if (occupancy == null) {
                    occupancy = placement.occupancy(physics::pose);
                }
                boolean done = applyTeleport(
                        i, place, tick, occupancy, physics, devices.get(i).position2d());
                if (done && contents.isAway(i)) {
                    contents.setAway(i, false);
                    returned = true;
                }
            }
        }
        if (returned) {
            placement = contents.placement();
        }
        for (int i = 0; i < robotCommands.size(); i++) {
            RobotCommands commands = robotCommands.get(i);
            Position2d odometry = devices.get(i).position2d();
            Pose toSet = commands.takeOdometry();
            if (toSet != null) {
                odometry.set(physics.pose(i), toSet);
                if (log != null) {
                    log.odometry(i, toSet);
                }
            }
            commands.apply(nowMicros, log);
            if (contents.isAway(i)) {
                commands.stop();
            }
            commands.steer(odometry);
            physics.drive(i, commands.forwardMps(), commands.sidewaysMps(), commands.turnRadps());
        }
        if (!deviceCommands.isEmpty()) {
            applyDeviceCommands(log, devices, scene);
        }
        return changed || returned;
    }

    private void applyDeviceCommands(@Nullable Recording log, List<SimulatedDevices> devices, Scene scene) {
        for (DeviceCommand next = deviceCommands.poll(); next != null; next = deviceCommands.poll()) {
            switch (next) {
                case DeviceCommand.Intensities(int robot, int number, boolean on) -> {
                    scene.readReflectances();
                    Ranger ranger = devices.get(robot).rangers().get(number);
                    if (ranger.measuresIntensities() != on) {
                        ranger.measureIntensities(on);
                        if (log != null) {
                            log.intensities(robot, number, on);
                        }
                    }
                }
                case DeviceCommand.Grip(int robot, int device, var order) -> {
                    ((GripperDevice) devices.get(robot).others().get(device)).order(order);
                    if (log != null) {
                        log.grip(robot, device, order);
                    }
                }
            }
        }
    }

    /** Takes away and puts what was demanded; robots come back by teleport. Returns whether anything has changed. */
    private boolean applyPresence(long tick, Physics physics, Grippers grippers) {
        Recording log = recording.get();
        boolean changed = false;
        for (int i = 0; i < robotCommands.size(); i++) {
            if (robotCommands.get(i).takeLeave() && !contents.isAway(i)) {
                contents.setAway(i, true);
                grippers.putDownAll(i);
                physics.removeRobot(i);
                changed = true;
                if (log != null) {
                    log.leave(i);
                }
            }
        }
        SortedMap<Integer, Optional<Pose>> demands = contents.takeDemands();
        if (demands.isEmpty()) { // iterating would allocate
            placement = changed ? contents.placement() : placement;
            return changed;
        }
        for (var demand : demands.entrySet()) {
            int obstacle = demand.getKey();
            if (demand.getValue().isEmpty() && contents.holds(obstacle)) {
                contents.remove(obstacle);
                if (grippers.moves(obstacle)) {
                    grippers.remove(obstacle);
                } else {
                    physics.removeObstacle(obstacle);
                }
                changed = true;
                if (log != null) {
                    log.removeObstacle(obstacle);
                }
            }
        }
        if (changed) {
            placement = contents.placement();
        }
        boolean placed = false;
        for (var demand : demands.entrySet()) {
            Pose pose = demand.getValue().orElse(null);
            placed |= pose != null && applyObstacle(demand.getKey(), pose, tick, physics, grippers);
        }
        if (placed) {
            placement = contents.placement();
        }
        return changed || placed;
    }

    private boolean applyObstacle(int obstacle, Pose pose, long tick, Physics physics, Grippers grippers) {
        ObstacleSpec body = spec.obstacles().get(obstacle);
        String refusal = placement.occupancy(physics::pose).refusal(body, movers.indexOf(obstacle), pose);
        if (refusal != null) {
            System.getLogger(World.class.getName()).log(System.Logger.Level.WARNING, "at tick " + tick + " " + refusal);
            return false;
        }
        if (grippers.moves(obstacle)) {
            contents.show(obstacle);
            placement = contents.placement(); // of the next obstacle that is placed
            grippers.put(obstacle, pose);
        } else {
            contents.place(obstacle, pose);
            physics.placeObstacle(obstacle, pose, PhysicsSetup.blockingShape(body));
        }
        Recording log = recording.get();
        if (log != null) {
            log.placeObstacle(obstacle, pose);
        }
        return true;
    }

    private boolean applyTeleport(
            int robot,
            Pose place,
            long tick,
            PlacementCheck.Occupancy occupancy,
            Physics physics,
            Position2d odometry) {
        String refusal = occupancy.refusal(robot, place);
        if (refusal != null) {
            System.getLogger(World.class.getName()).log(System.Logger.Level.WARNING, "at tick " + tick + " " + refusal);
            return false;
        }
        physics.teleport(robot, place);
        occupancy.moved(robot);
        odometry.teleported(place);
        Recording log = recording.get();
        if (log != null) {
            log.teleport(robot, place);
        }
        return true;
    }

    /** Speed in the interval that has ended. */
    double forwardMps(int robot) {
        return robotCommands.get(robot).forwardMps();
    }

    /** Speed to the left in the interval that has ended. */
    double sidewaysMps(int robot) {
        return robotCommands.get(robot).sidewaysMps();
    }

    /** Turn rate in the interval that has ended. */
    double turnRadps(int robot) {
        return robotCommands.get(robot).turnRadps();
    }
}
