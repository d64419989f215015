package io.troupe.sim;

import io.troupe.sim.device.Position2d;
import io.troupe.sim.model.DriveSpec;
import io.troupe.sim.model.DriveSpec.Steering;
import io.troupe.sim.model.Pose;
import java.util.Optional;
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
    private final double intervalS;
    private final AtomicReference<@Nullable PendingDrive> newestDrive = new AtomicReference<>();
    private final AtomicReference<@Nullable Boolean> newestPower = new AtomicReference<>();
    private final AtomicReference<@Nullable Pose> newestOdometry = new AtomicReference<>();
    private final AtomicReference<@Nullable Optional<Pose>> newestPlace = new AtomicReference<>(); // empty = leave
    private boolean hasDirect; // a speed from the thread that advances the world is pending
    private double directForwardMps;
    private double directTurnRadps;
    private @Nullable MotionCommand steering; // null: the held speeds below apply
    private double heldForwardMps;
    private double heldSidewaysMps;
    private double heldTurnRadps;
    private double sidewaysMps;
    private double forwardMps; // in force in the interval that has ended
    private double turnRadps;
    private boolean powered = true;
    private long commandedAtMicros;
    private long limitMicros; // of the current command; 0 = none

    RobotCommands(DriveSpec spec, int robot, WorldSettings settings, double intervalS) {
        this.intervalS = intervalS;
        this.spec = spec;
        this.robot = robot;
        this.settings = settings;
        hold(spec.startForwardMps(), spec.startSidewaysMps(), spec.startTurnRadps(), 0, 0);
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
        newestPlace.set(Optional.of(pose));
    }

    void remove() {
        newestPlace.set(Optional.empty());
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
        Optional<Pose> place = newestPlace.get();
        return place != null && place.isPresent() && newestPlace.compareAndSet(place, null) ? place.get() : null;
    }

    /** True if the robot has to leave; a newer teleport replaces that. */
    boolean takeLeave() {
        Optional<Pose> place = newestPlace.get();
        return place != null && place.isEmpty() && newestPlace.compareAndSet(place, null);
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
                recordDirect(recording, steering != null || differs(directForwardMps, 0, directTurnRadps));
                hold(directForwardMps, 0, directTurnRadps, nowMicros, 0);
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

    void stop() {
        steering = null;
        heldForwardMps = 0;
        heldSidewaysMps = 0;
        heldTurnRadps = 0;
        limitMicros = 0;
    }

    /**
     * Stops the robot when its command limit has expired. Recorded as a command to stand still, because a replay has no
     * clients and so no command limits.
     */
    private void expire(@Nullable Recording recording) {
        if (recording != null && (steering != null || differs(0, 0, 0))) {
            recording.drive(robot, MotionCommand.STILL);
        }
        stop();
    }

    private void accept(MotionCommand command, long newLimitMicros, long nowMicros, @Nullable Recording recording) {
        if (command instanceof MotionCommand.Velocity velocity) {
            if (recording != null
                    && (isWatched()
                            || steering != null
                            || differs(velocity.forwardMps(), velocity.sidewaysMps(), velocity.turnRadps()))) {
                recording.drive(robot, velocity);
            }
            hold(velocity.forwardMps(), velocity.sidewaysMps(), velocity.turnRadps(), nowMicros, newLimitMicros);
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

    private boolean differs(double newForwardMps, double newSidewaysMps, double newTurnRadps) {
        return Double.compare(newForwardMps, heldForwardMps) != 0
                || newSidewaysMps != heldSidewaysMps
                || Double.compare(newTurnRadps, heldTurnRadps) != 0;
    }

    private void hold(
            double newForwardMps, double newSidewaysMps, double newTurnRadps, long nowMicros, long newLimitMicros) {
        steering = null;
        heldForwardMps = newForwardMps;
        heldSidewaysMps = newSidewaysMps;
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
            approach(heldForwardMps, heldSidewaysMps, heldTurnRadps);
        } else {
            MotionCommand.Velocity wanted = how.now(odometry.reported(), spec.steering());
            approach(wanted.forwardMps(), wanted.sidewaysMps(), wanted.turnRadps());
        }
    }

    /** Sets the speeds to the wanted ones, as far as the bounds and the kind of drive allow. */
    private void approach(double wantedForwardMps, double wantedSidewaysMps, double wantedTurnRadps) {
        double beforeForwardMps = forwardMps;
        double beforeSidewaysMps = sidewaysMps;
        double beforeTurnRadps = turnRadps;
        if (spec.steering() instanceof Steering.Car car) {
            clamp(
                    wantedForwardMps * StrictMath.cos(wantedTurnRadps),
                    0,
                    wantedForwardMps * StrictMath.sin(wantedTurnRadps) / car.wheelbaseM());
        } else {
            clamp(wantedForwardMps, wantedSidewaysMps, wantedTurnRadps);
        }
        if (settings.obeysAccelerationBounds()) {
            DriveSpec.Bounds bounds = spec.accelerationBounds();
            forwardMps = limited(beforeForwardMps, forwardMps, bounds.leastForward(), bounds.mostForward());
            sidewaysMps = limited(beforeSidewaysMps, sidewaysMps, bounds.leastSideways(), bounds.mostSideways());
            turnRadps = limited(beforeTurnRadps, turnRadps, bounds.leastTurn(), bounds.mostTurn());
        }
    }

    /** @param least of the acceleration, as is {@code most} */
    private double limited(double before, double wanted, double least, double most) {
        return Math.clamp(wanted, before + least * intervalS, before + most * intervalS);
    }

    private void clamp(double wantedForwardMps, double wantedSidewaysMps, double wantedTurnRadps) {
        DriveSpec.Bounds bounds = spec.velocityBounds();
        forwardMps = clamp(wantedForwardMps, bounds.leastForward(), bounds.mostForward(), settings.maxForwardMps());
        sidewaysMps = wantedSidewaysMps == 0
                ? 0
                : clamp(wantedSidewaysMps, bounds.leastSideways(), bounds.mostSideways(), settings.maxForwardMps());
        turnRadps = clamp(wantedTurnRadps, bounds.leastTurn(), bounds.mostTurn(), settings.maxTurnRadps());
    }

    private static double clamp(double wanted, double least, double most, double limit) {
        return Math.clamp(Math.clamp(wanted, least, most), -limit, limit);
    }

    double forwardMps() {
        return forwardMps;
    }

    double sidewaysMps() {
        return sidewaysMps;
    }

    double turnRadps() {
        return turnRadps;
    }

    /** Resets the robot to its start speeds. */
    void forget(long nowMicros) {
        hold(spec.startForwardMps(), spec.startSidewaysMps(), spec.startTurnRadps(), nowMicros, 0);
        hasDirect = false;
        powered = true;
        clamp(0, 0, 0);
    }
}
