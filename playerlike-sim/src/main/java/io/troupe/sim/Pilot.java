package io.troupe.sim;

import io.troupe.sim.scenario.Pose;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/**
 * What one robot has been told: what waits for the next interval, and what holds.
 *
 * <p><b>Threads.</b> Any thread may tell; {@code take..}, {@link #latch} and {@link #forget} belong to the one that advances the world.
 */
final class Pilot {
    private final int robot;
    private final long watchdogMicros;
    private final AtomicReference<@Nullable Drive> newestDrive = new AtomicReference<>();
    private final AtomicReference<@Nullable Boolean> newestPower = new AtomicReference<>();
    private final AtomicReference<@Nullable Pose> newestOdometry = new AtomicReference<>();
    private final AtomicReference<@Nullable Pose> newestPlace = new AtomicReference<>();
    private Drive drive = Drive.STILL;
    private boolean powered = true;
    private long toldAtMicros;

    Pilot(int robot, long watchdogMicros) {
        this.robot = robot;
        this.watchdogMicros = watchdogMicros;
    }

    void drive(Drive command) {
        newestDrive.set(command);
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

    @Nullable
    Pose takeTeleport() {
        return newestPlace.getAndSet(null);
    }

    @Nullable
    Pose takeOdometry() {
        return newestOdometry.getAndSet(null);
    }

    /** What holds from now on: the newest command, unless the motors are off, which forgets what they were told, or the watchdog has barked. */
    Drive latch(long nowMicros, @Nullable Recording recording) {
        Boolean power = newestPower.getAndSet(null);
        if (power != null && power != powered) {
            powered = power;
            note(recording, power);
        }
        Drive command = newestDrive.getAndSet(null);
        if (command != null && powered) {
            if (recording != null && (watchdogMicros > 0 || !command.equals(drive))) {
                recording.drive(robot, command);
            }
            drive = command;
            toldAtMicros = nowMicros;
        }
        if (!powered || isLate(nowMicros)) {
            drive = Drive.STILL;
        }
        return drive;
    }

    private void note(@Nullable Recording recording, boolean power) {
        if (recording != null) {
            recording.power(robot, power);
        }
    }

    /** A goal is reached some time; a speed would hold for ever. */
    private boolean isLate(long nowMicros) {
        return watchdogMicros > 0 && !(drive instanceof Drive.GoTo) && nowMicros - toldAtMicros >= watchdogMicros;
    }

    /** The world starts again. */
    void forget(long nowMicros) {
        drive = Drive.STILL;
        powered = true;
        toldAtMicros = nowMicros;
    }
}
