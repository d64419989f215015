package io.troupe.sim;

import io.troupe.sim.device.Position2d;
import io.troupe.sim.scenario.DriveSpec;
import io.troupe.sim.scenario.Pose;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/**
 * What one robot has been told: what waits for the next interval, and what holds.
 *
 * <p><b>Threads.</b> Any thread may tell, unless a method says otherwise; the rest belongs to the one that advances the world.
 * <p><b>Cost.</b> What the advancing thread tells by {@link #driveNow} allocates nothing.
 */
final class Pilot {
    private final DriveSpec spec;
    private final int robot;
    private final WorldSettings settings;
    private final AtomicReference<@Nullable Drive> newestDrive = new AtomicReference<>();
    private final AtomicReference<@Nullable Boolean> newestPower = new AtomicReference<>();
    private final AtomicReference<@Nullable Pose> newestOdometry = new AtomicReference<>();
    private final AtomicReference<@Nullable Pose> newestPlace = new AtomicReference<>();
    private boolean toldNow; // by the thread that advances the world
    private double toldForwardMps;
    private double toldTurnRadps;
    private @Nullable Drive steering; // else the speeds below hold
    private double heldForwardMps;
    private double heldTurnRadps;
    private double forwardMps; // in force in the interval that has ended
    private double turnRadps;
    private boolean powered = true;
    private long toldAtMicros;

    Pilot(DriveSpec spec, int robot, WorldSettings settings) {
        this.spec = spec;
        this.robot = robot;
        this.settings = settings;
        hold(spec.startForwardMps(), spec.startTurnRadps(), 0);
    }

    void drive(Drive command) {
        newestDrive.set(command);
    }

    /** A speed told by the thread that advances the world, newer than what the others said. */
    void driveNow(double newForwardMps, double newTurnRadps) {
        if (newestDrive.get() != null) {
            newestDrive.set(null);
        }
        toldNow = true;
        toldForwardMps = newForwardMps;
        toldTurnRadps = newTurnRadps;
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

    /** Forgets what waits for the next interval. */
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

    /** Looks before it takes: that is cheaper, and mostly there is nothing. */
    private static <T> @Nullable T take(AtomicReference<@Nullable T> newest) {
        return newest.get() == null ? null : newest.getAndSet(null);
    }

    /** What holds from now on: the newest command, unless the motors are off, which forgets what they were told, or the watchdog has barked. */
    void latch(long nowMicros, @Nullable Recording recording) {
        Boolean power = take(newestPower);
        if (power != null && power != powered) {
            powered = power;
            if (recording != null) {
                recording.power(robot, power);
            }
        }
        if (toldNow) {
            toldNow = false;
            if (powered) {
                note(recording, steering != null || differs(toldForwardMps, toldTurnRadps));
                hold(toldForwardMps, toldTurnRadps, nowMicros);
            }
        }
        Drive command = take(newestDrive);
        if (command != null && powered) {
            accept(command, nowMicros, recording);
        }
        if (!powered || isLate(nowMicros)) {
            steering = null;
            heldForwardMps = 0;
            heldTurnRadps = 0;
        }
    }

    private void accept(Drive command, long nowMicros, @Nullable Recording recording) {
        if (command instanceof Drive.Velocity velocity) {
            if (recording != null
                    && (isWatched() || steering != null || differs(velocity.forwardMps(), velocity.turnRadps()))) {
                recording.drive(robot, velocity);
            }
            hold(velocity.forwardMps(), velocity.turnRadps(), nowMicros);
            return;
        }
        if (recording != null && (isWatched() || !command.equals(steering))) {
            recording.drive(robot, command);
        }
        steering = command;
        toldAtMicros = nowMicros;
    }

    private void note(@Nullable Recording recording, boolean changes) {
        if (recording != null && (isWatched() || changes)) {
            recording.drive(robot, new Drive.Velocity(toldForwardMps, toldTurnRadps));
        }
    }

    private boolean differs(double newForwardMps, double newTurnRadps) {
        return Double.compare(newForwardMps, heldForwardMps) != 0 || Double.compare(newTurnRadps, heldTurnRadps) != 0;
    }

    private void hold(double newForwardMps, double newTurnRadps, long nowMicros) {
        steering = null;
        heldForwardMps = newForwardMps;
        heldTurnRadps = newTurnRadps;
        toldAtMicros = nowMicros;
    }

    private boolean isWatched() {
        return settings.watchdogMicros() > 0;
    }

    /** A goal is reached some time; a speed would hold for ever. */
    private boolean isLate(long nowMicros) {
        return isWatched()
                && !(steering instanceof Drive.GoTo)
                && nowMicros - toldAtMicros >= settings.watchdogMicros();
    }

    /** Turns what holds into the speeds of the next interval, given where odometry says that the robot is. */
    void steer(Position2d odometry) {
        Drive how = steering;
        if (how == null) {
            clamp(heldForwardMps, heldTurnRadps);
        } else {
            Drive.Velocity wanted = how.now(odometry.reported());
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

    /** The world starts again. */
    void forget(long nowMicros) {
        hold(spec.startForwardMps(), spec.startTurnRadps(), nowMicros);
        toldNow = false;
        powered = true;
        clamp(0, 0);
    }
}
