package io.troupe.sim;

import io.troupe.sim.device.GripperDevice;
import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * Writes all input of a world to a text file, with the tick at which it took effect. Where a client was silent for too
 * long, the stop of its robot is written as a command, because a replay has no clients.
 *
 * <p><b>Role.</b> Created by {@link World#record}; {@link Replay} reads the file and repeats the run. {@link #close}
 * writes the last line and closes the output. A recording without that line counts as cut off.
 *
 * <p><b>Threads.</b> Any thread.
 *
 * <p><b>Units and shapes.</b> Lines of text. Each begins with the tick of the newest snapshot at the time when the
 * input took effect. Numbers are written so that reading them restores the same bits. A checksum over all snapshots so
 * far is written at every hundredth tick and at the end.
 *
 * <p><b>Errors.</b> {@link UncheckedIOException} from {@link World#advance} and {@link #close} when the output fails.
 */
public final class Recording implements AutoCloseable {
    static final String TITLE = "troupe-recording 1";
    static final int CHECK_TICKS = 100;
    static final int LONGEST_NAME = 1_000;

    private final Appendable out;
    private final SnapshotHash hash = new SnapshotHash();
    private final StringBuilder line = new StringBuilder();
    private long tick;
    private boolean closed;

    Recording(Appendable out, WorldSpec spec, WorldSettings settings, Snapshot first) {
        this.out = Objects.requireNonNull(out, "out");
        line.append(TITLE).append('\n');
        line.append("world ").append(onOneLine(spec.name())).append('\n');
        line.append("settings ").append(settings.words()).append('\n');
        line.append("robots ").append(spec.robots().size());
        hash.update(first);
        line.append(" start ").append(hash).append('\n');
        write();
    }

    private static String onOneLine(String name) {
        return name.substring(0, Math.min(name.length(), LONGEST_NAME)).replaceAll("\\R", " ");
    }

    synchronized void reset() {
        begin("reset");
        write();
    }

    synchronized void teleport(int robot, Pose pose) {
        begin("teleport").append(' ').append(robot);
        write(pose);
    }

    synchronized void leave(int robot) {
        begin("leave").append(' ').append(robot);
        write();
    }

    synchronized void removeObstacle(int obstacle) {
        begin("remove").append(' ').append(obstacle);
        write();
    }

    synchronized void placeObstacle(int obstacle, Pose pose) {
        begin("place").append(' ').append(obstacle);
        write(pose);
    }

    /** @param box null = it was removed */
    synchronized void box(int number, @Nullable ColouredBox box) {
        begin(box == null ? "unbox " + number : "box " + box.words());
        write();
    }

    synchronized void odometry(int robot, Pose pose) {
        begin("odometry").append(' ').append(robot);
        write(pose);
    }

    synchronized void power(int robot, boolean on) {
        begin("power").append(' ').append(robot).append(on ? " on" : " off");
        write();
    }

    synchronized void intensities(int robot, int ranger, boolean on) {
        begin("intensities").append(' ').append(robot).append(' ').append(ranger);
        line.append(on ? " on" : " off");
        write();
    }

    synchronized void grip(int robot, int device, GripperDevice.Order order) {
        begin("gripper").append(' ').append(robot).append(' ').append(device);
        line.append(order == GripperDevice.Order.OPEN ? " open" : " close");
        write();
    }

    synchronized void drive(int robot, MotionCommand drive) {
        switch (drive) {
            case MotionCommand.Velocity velocity
            when velocity.sidewaysMps() != 0 -> {
                begin("omni").append(' ').append(robot);
                line.append(' ').append(velocity.forwardMps()).append(' ').append(velocity.sidewaysMps());
                line.append(' ').append(velocity.turnRadps());
                write();
            }
            case MotionCommand.Velocity velocity -> {
                begin("velocity").append(' ').append(robot);
                line.append(' ').append(velocity.forwardMps()).append(' ').append(velocity.turnRadps());
                write();
            }
            case MotionCommand.Heading heading -> {
                begin("heading").append(' ').append(robot);
                line.append(' ').append(heading.forwardMps()).append(' ').append(heading.headingRad());
                write();
            }
            case MotionCommand.GoTo goTo -> {
                begin("goto").append(' ').append(robot);
                write(goTo.goal());
            }
        }
    }

    /** Information for the reader of the file; it does not change the world. */
    synchronized void paused(boolean paused) {
        if (!closed) {
            begin(paused ? "pause" : "resume");
            write();
        }
    }

    synchronized void advanced(Snapshot snapshot) {
        tick = snapshot.tick();
        hash.update(snapshot);
        if (tick % CHECK_TICKS == 0 && !closed) {
            begin("is").append(' ').append(hash);
            write();
        }
    }

    /** Writes the last line and closes the output; the world continues without recording. */
    @Override
    public synchronized void close() {
        if (closed) {
            return;
        }
        begin("end").append(' ').append(hash);
        try {
            write();
        } finally {
            closed = true;
            closeOutput();
        }
    }

    private void closeOutput() {
        if (out instanceof AutoCloseable closeable) {
            try {
                closeable.close();
            } catch (IOException e) {
                throw new UncheckedIOException("the recording could not be closed: " + e.getMessage(), e);
            } catch (Exception e) {
                throw new IllegalStateException("the recording could not be closed: " + e.getMessage(), e);
            }
        }
    }

    /** Checksum over all snapshots so far. */
    public synchronized long hash() {
        return hash.value();
    }

    private StringBuilder begin(String word) {
        return line.append(tick).append(' ').append(word);
    }

    private void write(Pose pose) {
        line.append(' ')
                .append(pose.x())
                .append(' ')
                .append(pose.y())
                .append(' ')
                .append(pose.headingRad());
        write();
    }

    private void write() {
        if (line.charAt(line.length() - 1) != '\n') {
            line.append('\n');
        }
        try {
            if (!closed) {
                out.append(line);
            }
        } catch (IOException e) {
            throw new UncheckedIOException(
                    "the recording cannot be written at tick " + tick + ": " + e.getMessage(), e);
        } finally {
            line.setLength(0);
        }
    }
}
