package io.troupe.sim;

import io.troupe.sim.device.Position2d;
import io.troupe.sim.model.DriveSpec;
import io.troupe.sim.model.Pose;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/**
 * The commands for one robot: the pending ones, which wait for the next interval, and the current one.
 *
 * <p><b>Threads.</b> Any thread may send commands, unless a method is documented otherwise; the rest belongs to the
 * thread that advances the world.
 *
 * <p><b>Cost.</b> {@link #driveNow} allocates nothing.
 */
final class RobotCommands {
    /**
     * A command that waits for the next interval.
     *
     * @param limitMicros time for which a speed holds; 0 = until another command
     */
    private record PendingDrive(MotionCommand drive, long limitMicros) {}

    private final DriveSpec spec;
    private final int robot;
    private final WorldSettings settings;
    private final AtomicReference<@Nullable PendingDrive> newestDrive = new AtomicReference<>();
    private final AtomicReference<@Nullable Boolean> newestPower = new AtomicReference<>();
    private final AtomicReference<@Nullable Pose> newestOdometry = new AtomicReference<>();
    private final AtomicReference<@Nullable Pose> newestPlace = new AtomicReference<>();
    private boolean hasDirect; // a speed from the thread that advances the world is pending
    private double directForwardMps;
    private double directTurnRadps;
    private @Nullable MotionCommand steering; // null: the held speeds below apply
    private double heldForwardMps;
    private double heldTurnRadps;
    private double forwardMps; // in force in the interval that has ended
    private double turnRadps;
    private boolean powered = true;
    private long commandedAtMicros;
    private long limitMicros; // of the current command; 0 = none

    RobotCommands(DriveSpec spec, int robot, WorldSettings settings) {
        this.spec = spec;
        this.robot = robot;
        this.settings = settings;
        hold(spec.startForwardMps(), spec.startTurnRadps(), 0, 0);
    }

    /** @param newLimitMicros time for which a speed holds; 0 = until another command, as always for a goal */
    void drive(MotionCommand command, long newLimitMicros) {
        newestDrive.set(new PendingDrive(command, command instanceof MotionCommand.GoTo ? 0 : newLimitMicros));
    }

    /** Speed command from the thread that advances the world; replaces a pending command of another thread. */
    void driveNow(double newForwardMps, double newTurnRadps) {
        if (newestDrive.get() != null) {
            newestDrive.set(null);
        }
        hasDirect = true;
        directForwardMps = newForwardMps;
        directTurnRadps = newTurnRadps;
    }

    void power(boolean on) {
        newestPower.set(on);
    }

    void odometry(Pose pose) {
        newestOdometry.set(pose);
    }

    void teleport(Pose pose) {
        newestPlace.set(pose);
    }

    /** Discards the pending commands. */
    void forgetUntaken() {
        newestDrive.set(null);
        newestPower.set(null);
        newestOdometry.set(null);
        newestPlace.set(null);
    }

    @Nullable
    Pose takeTeleport() {
        return take(newestPlace);
    }

    @Nullable
    Pose takeOdometry() {
        return take(newestOdometry);
    }

    /** Reads before it swaps: that is cheaper, and mostly the value is null. */
    private static <T> @Nullable T take(AtomicReference<@Nullable T> newest) {
        return newest.get() == null ? null : newest.getAndSet(null);
    }

    /**
     * Applies the newest command. Motors off, an expired command limit or an expired watchdog stop the robot and
     * discard its command.
     */
    void apply(long nowMicros, @Nullable Recording recording) {
        Boolean power = take(newestPower);
        if (power != null && power != powered) {
            powered = power;
            if (recording != null) {
                recording.power(robot, power);
            }
        }
        if (hasDirect) {
            hasDirect = false;
            if (powered) {
                recordDirect(recording, steering != null || differs(directForwardMps, directTurnRadps));
                hold(directForwardMps, directTurnRadps, nowMicros, 0);
            }
        }
        PendingDrive command = take(newestDrive);
        if (command != null && powered) {
            accept(command.drive, command.limitMicros, nowMicros, recording);
        }
        if (!powered || isLate(nowMicros)) {
            stop();
        } else if (limitMicros > 0 && nowMicros - commandedAtMicros >= limitMicros) {
            expire(recording);
        }
    }

    private void stop() {
        steering = null;
        heldForwardMps = 0;
        heldTurnRadps = 0;
        limitMicros = 0;
    }

    /**
     * Stops the robot when its command limit has expired. Recorded as a command to stand still, because a replay has no
     * clients and so no command limits.
     */
    private void expire(@Nullable Recording recording) {
        if (recording != null && (steering != null || differs(0, 0))) {
            recording.drive(robot, MotionCommand.STILL);
        }
        stop();
    }

    private void accept(MotionCommand command, long newLimitMicros, long nowMicros, @Nullable Recording recording) {
        if (command instanceof MotionCommand.Velocity velocity) {
            if (recording != null
                    && (isWatched() || steering != null || differs(velocity.forwardMps(), velocity.turnRadps()))) {
                recording.drive(robot, velocity);
            }
            hold(velocity.forwardMps(), velocity.turnRadps(), nowMicros, newLimitMicros);
            return;
        }
        if (recording != null && (isWatched() || !command.equals(steering))) {
            recording.drive(robot, command);
        }
        steering = command;
        commandedAtMicros = nowMicros;
        limitMicros = newLimitMicros;
    }

    private void recordDirect(@Nullable Recording recording, boolean changes) {
        if (recording != null && (isWatched() || changes)) {
            recording.drive(robot, new MotionCommand.Velocity(directForwardMps, directTurnRadps));
        }
    }

    private boolean differs(double newForwardMps, double newTurnRadps) {
        return Double.compare(newForwardMps, heldForwardMps) != 0 || Double.compare(newTurnRadps, heldTurnRadps) != 0;
    }

    private void hold(double newForwardMps, double newTurnRadps, long nowMicros, long newLimitMicros) {
        steering = null;
        heldForwardMps = newForwardMps;
        heldTurnRadps = newTurnRadps;
        commandedAtMicros = nowMicros;
        limitMicros = newLimitMicros;
    }

    private boolean isWatched() {
        return settings.watchdogMicros() > 0;
    }

    /**
     * True if the watchdog has expired. It does not watch a robot on its way to a goal: that command ends by itself,
     * while a speed would hold for ever.
     */
    private boolean isLate(long nowMicros) {
        return isWatched()
                && !(steering instanceof MotionCommand.GoTo)
                && nowMicros - commandedAtMicros >= settings.watchdogMicros();
    }

    /** Computes the speeds of the next interval from the current command and the reported odometry. */
    void steer(Position2d odometry) {
        MotionCommand how = steering;
        if (how == null) {
            clamp(heldForwardMps, heldTurnRadps);
        } else {
            MotionCommand.Velocity wanted = how.now(odometry.reported());
            clamp(wanted.forwardMps(), wanted.turnRadps());
        }
    }

    private void clamp(double wantedForwardMps, double wantedTurnRadps) {
        DriveSpec.Bounds bounds = spec.velocityBounds();
        forwardMps = clamp(wantedForwardMps, bounds.leastForward(), bounds.mostForward(), settings.maxForwardMps());
        turnRadps = clamp(wantedTurnRadps, bounds.leastTurn(), bounds.mostTurn(), settings.maxTurnRadps());
    }

    private static double clamp(double wanted, double least, double most, double limit) {
        return Math.clamp(Math.clamp(wanted, least, most), -limit, limit);
    }

    double forwardMps() {
        return forwardMps;
    }

    double turnRadps() {
        return turnRadps;
    }

    /** Resets the robot to its start speeds. */
    void forget(long nowMicros) {
        hold(spec.startForwardMps(), spec.startTurnRadps(), nowMicros, 0);
        hasDirect = false;
        powered = true;
        clamp(0, 0);
    }
}
