package io.troupe.sim;

import io.troupe.sim.device.BlobImage;
import io.troupe.sim.device.ColourBlob;
import io.troupe.sim.device.DeviceReading;
import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.Pose;
import java.nio.ByteBuffer;
import java.util.List;
import java.util.zip.CRC32C;
import org.jspecify.annotations.Nullable;

/**
 * Checksum over every bit of a sequence of snapshots: equal runs have equal checksums, and different runs almost
 * certainly have different ones.
 *
 * <p><b>Order.</b> The checksum depends on the order of the snapshots. <b>Threads.</b> One thread at a time.
 *
 * <p><b>Source.</b> CRC-32C over the numbers in the order of the records; a double by its bits, a list with its length
 * first. What few worlds have (from {@code moved} on, and the intensities and devices of a robot) is added only if
 * there is something, after a number for what it is: a world without it has the checksum of versions that did not know
 * it.
 */
public final class SnapshotHash {
    // what follows
    private static final int MOVED = 1;
    private static final int BOXES = 2;
    private static final int PLACED = 3;
    private static final int AWAY = 4;
    private static final int HELD = 5;
    private static final int SIDEWAYS = 6;
    private static final int INTENSITIES = 7;
    private static final int DEVICES = 8;

    private final CRC32C crc = new CRC32C();
    private final ByteBuffer buffer = ByteBuffer.allocate(1 << 13);

    /** Checksum of a single snapshot. */
    public static long of(Snapshot snapshot) {
        var hash = new SnapshotHash();
        hash.update(snapshot);
        return hash.value();
    }

    /** Adds the next snapshot. */
    public void update(Snapshot snapshot) {
        add(snapshot.tick());
        add(snapshot.timeMicros());
        add(snapshot.robots().size());
        snapshot.robots().forEach(this::add);
        add(snapshot.contacts().size());
        for (Contact contact : snapshot.contacts()) {
            add(contact.timeMicros());
            add(contact.robot());
            add(contact.otherRobot());
            add(contact.other());
        }
        addRare(snapshot);
    }

    private void addRare(Snapshot snapshot) {
        begin(MOVED, snapshot.moved().size());
        snapshot.moved().forEach(this::add);
        begin(BOXES, snapshot.boxes().size());
        for (ColouredBox box : snapshot.boxes()) {
            add(box.number());
            add(box.colour());
            add(box.x());
            add(box.y());
        }
        begin(PLACED, snapshot.placed().size());
        snapshot.placed().forEach((obstacle, pose) -> {
            add(obstacle);
            add(pose.isPresent() ? 1 : 0);
            pose.ifPresent(this::add);
        });
        begin(AWAY, snapshot.away().size());
        snapshot.away().forEach(this::add);
        begin(HELD, snapshot.held().size());
        snapshot.held().forEach((obstacle, robot) -> {
            add(obstacle);
            add(robot);
        });
    }

    /** Begins a list that few worlds have. */
    private void begin(int which, int size) {
        if (size > 0) {
            add(-1 - which);
            add(size);
        }
    }

    /** Checksum so far, from 0 to 2^32 - 1. */
    public long value() {
        flush();
        return crc.getValue();
    }

    /** The checksum as eight hexadecimal digits. */
    @Override
    public String toString() {
        return String.format("%08x", value());
    }

    private void add(RobotReading robot) {
        add(robot.pose());
        add(robot.odometry().pose());
        add(robot.odometry().forwardMps());
        add(robot.odometry().turnRadps());
        if (robot.odometry().sidewaysMps() != 0) {
            begin(SIDEWAYS, 1);
            add(robot.odometry().sidewaysMps());
        }
        add(robot.odometry().stalled() ? 1 : 0);
        addAll(robot.sonarM());
        add(robot.blobs());
        add(robot.rangersM().size());
        robot.rangersM().forEach(this::addAll);
        begin(INTENSITIES, robot.intensities().size());
        robot.intensities().forEach(this::addAll);
        begin(DEVICES, robot.devices().size());
        robot.devices().forEach(this::add);
        add(robot.wallGapM());
    }

    private void add(DeviceReading device) {
        switch (device) {
            case DeviceReading.Fiducials(var seen) -> {
                add(1);
                add(seen.size());
                for (DeviceReading.Fiducial each : seen) {
                    add(each.id());
                    add(each.x());
                    add(each.y());
                    add(each.headingRad());
                }
            }
            case DeviceReading.Picture(int heightPx, var columns) -> {
                add(2);
                add(heightPx);
                add(columns.size());
                for (DeviceReading.Column column : columns) {
                    add(column.colour());
                    add(column.top());
                    add(column.bottom());
                }
            }
            case DeviceReading.Grip(var paddles, boolean outer, boolean inner, boolean holds) -> {
                add(3);
                add(paddles.ordinal());
                add((outer ? 1 : 0) + (inner ? 2 : 0) + (holds ? 4 : 0));
            }
            case DeviceReading.Pressed(var bumpers) -> {
                add(4);
                add(bumpers.size());
                bumpers.forEach(each -> add(each ? 1 : 0));
            }
            case DeviceReading.Unknown unknown -> add(-1);
        }
    }

    private void add(Pose pose) {
        add(pose.x());
        add(pose.y());
        add(pose.headingRad());
    }

    private void addAll(@Nullable List<Double> values) {
        if (values == null) {
            add(-1);
            return;
        }
        add(values.size());
        for (int i = 0; i < values.size(); i++) {
            add(values.get(i).doubleValue());
        }
    }

    private void add(@Nullable BlobImage image) {
        if (image == null) {
            add(-1);
            return;
        }
        add(image.widthPx());
        add(image.heightPx());
        add(image.blobs().size());
        for (ColourBlob blob : image.blobs()) {
            add(blob.colour());
            add(blob.areaPx2());
            add(blob.x());
            add(blob.y());
            add(blob.left());
            add(blob.right());
            add(blob.top());
            add(blob.bottom());
            add(blob.rangeM());
        }
    }

    private void add(String text) {
        add(text.length());
        for (int i = 0; i < text.length(); i++) {
            add(text.charAt(i));
        }
    }

    private void add(double value) {
        add(Double.doubleToRawLongBits(value));
    }

    private void add(long bits) {
        if (buffer.remaining() < Long.BYTES) {
            flush();
        }
        buffer.putLong(bits);
    }

    private void flush() {
        crc.update(buffer.flip());
        buffer.clear();
    }
}
