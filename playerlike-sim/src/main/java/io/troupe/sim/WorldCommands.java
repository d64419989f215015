package io.troupe.sim;

import io.troupe.sim.device.Position2d;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.physics.Physics;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/**
 * Commands for the robots of a world, buffered until the next interval begins, and the recording of them.
 *
 * <p><b>Threads.</b> Any thread may send commands. {@link #takeReset} and {@link #apply} belong to the thread that
 * advances the world.
 */
final class WorldCommands {
    private static final System.Logger LOG = System.getLogger(World.class.getName());

    /** Occupancy at the snapshot of the newest teleport check. */
    private record TeleportCheck(Snapshot at, PlacementCheck.Occupancy occupancy) {}

    private final WorldSpec spec;
    private final WorldSettings settings;
    private final PlacementCheck placement;
    private final AtomicReference<@Nullable TeleportCheck> lastCheck = new AtomicReference<>();
    private final List<RobotCommands> robotCommands = new ArrayList<>();
    private final AtomicBoolean resetWanted = new AtomicBoolean();
    private final AtomicReference<@Nullable Recording> recording = new AtomicReference<>();

    WorldCommands(WorldSpec spec, WorldSettings settings) {
        this.spec = spec;
        this.settings = settings;
        placement = new PlacementCheck(spec);
        for (int i = 0; i < spec.robots().size(); i++) {
            robotCommands.add(new RobotCommands(spec.robots().get(i).drive(), i, settings));
        }
    }

    // ---- from any thread

    /** @param limitMicros time for which the command holds; 0 = until another command */
    void drive(int robot, double forwardMps, double turnRadps, long limitMicros) {
        check(robot, forwardMps, turnRadps);
        robotCommands.get(robot).drive(new MotionCommand.Velocity(forwardMps, turnRadps), limitMicros);
    }

    /** Speed command from the thread that advances the world; replaces all commands sent so far by other threads. */
    void driveNow(int robot, double forwardMps, double turnRadps) {
        check(robot, forwardMps, turnRadps);
        robotCommands.get(robot).driveNow(forwardMps, turnRadps);
    }

    private void check(int robot, double forwardMps, double turnRadps) {
        RobotSpec target = robot(robot);
        if (!Double.isFinite(forwardMps) || !Double.isFinite(turnRadps)) {
            throw new IllegalArgumentException("robot '" + target.name() + "' was told to drive at " + forwardMps
                    + " m/s and " + turnRadps + " rad/s, expected finite numbers");
        }
    }

    /** @param limitMicros time for which the command holds; 0 = until another command */
    void steer(int robot, double forwardMps, double headingRad, long limitMicros) {
        RobotSpec target = robot(robot);
        if (!Double.isFinite(forwardMps) || !Double.isFinite(headingRad)) {
            throw new IllegalArgumentException("robot '" + target.name() + "' was told to drive at " + forwardMps
                    + " m/s to a heading of " + headingRad + " rad, expected finite numbers");
        }
        robotCommands.get(robot).drive(new MotionCommand.Heading(forwardMps, headingRad), limitMicros);
    }

    void goTo(int robot, Pose goal) {
        RobotSpec target = robot(robot);
        if (!isFinite(goal)) {
            throw new IllegalArgumentException(
                    "robot '" + target.name() + "' was told to go to " + goal + ", expected finite numbers");
        }
        robotCommands.get(robot).drive(new MotionCommand.GoTo(goal), 0);
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

    /** Reason why a robot could not be placed at a pose in the world of a snapshot, or null. */
    @Nullable
    String teleportRefusal(int robot, Pose pose, Snapshot at) {
        robot(robot);
        TeleportCheck known = lastCheck.get();
        if (known == null || known.at() != at) {
            known = new TeleportCheck(
                    at, placement.occupancy(other -> at.robots().get(other).pose()));
            lastCheck.set(known);
        }
        return known.occupancy().refusal(robot, pose);
    }

    /** Requests a reset. Commands sent from now on apply after it. */
    void reset() {
        robotCommands.forEach(RobotCommands::forgetUntaken);
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

    /**
     * Takes teleports, then odometry, motor power and commands, by robot index. Allocates nothing unless another thread
     * has sent a command.
     */
    void apply(long tick, long nowMicros, Physics physics, List<SimulatedDevices> devices) {
        Recording log = recording.get();
        PlacementCheck.Occupancy occupancy = null;
        for (int i = 0; i < robotCommands.size(); i++) {
            Pose place = robotCommands.get(i).takeTeleport();
            if (place != null) {
                if (occupancy == null) {
                    occupancy = placement.occupancy(physics::pose);
                }
                applyTeleport(i, place, tick, occupancy, physics, devices.get(i).position2d());
            }
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
            commands.steer(odometry);
            physics.drive(i, commands.forwardMps(), commands.turnRadps());
        }
    }

    private void applyTeleport(
            int robot,
            Pose place,
            long tick,
            PlacementCheck.Occupancy occupancy,
            Physics physics,
            Position2d odometry) {
        String refusal = occupancy.refusal(robot, place);
        if (refusal != null) {
            LOG.log(System.Logger.Level.WARNING, "at tick " + tick + " " + refusal);
            return;
        }
        physics.teleport(robot, place);
        occupancy.moved(robot);
        odometry.teleported(place);
        Recording log = recording.get();
        if (log != null) {
            log.teleport(robot, place);
        }
    }

    /** Speed in the interval that has ended. */
    double forwardMps(int robot) {
        return robotCommands.get(robot).forwardMps();
    }

    /** Turn rate in the interval that has ended. */
    double turnRadps(int robot) {
        return robotCommands.get(robot).turnRadps();
    }
}
