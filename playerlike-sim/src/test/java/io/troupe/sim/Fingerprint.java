package io.troupe.sim;

import io.troupe.sim.device.ColourBlob;
import io.troupe.sim.model.Pose;
import java.nio.ByteBuffer;
import java.util.zip.CRC32;

/** A checksum of snapshots over every bit of their numbers. */
final class Fingerprint {
    private final CRC32 crc = new CRC32();

    void add(Snapshot snapshot) {
        add(snapshot.tick());
        add(snapshot.timeMicros());
        for (RobotReading robot : snapshot.robots()) {
            add(robot.pose());
            add(robot.odometry().pose());
            add(robot.odometry().forwardMps());
            add(robot.odometry().turnRadps());
            add(robot.odometry().stalled() ? 1 : 0);
            add(robot.wallGapM());
            robot.sonarM().forEach(this::add);
            for (ColourBlob blob : robot.blobs().blobs()) {
                add((long) blob.hashCode()); // of ints and a double: the same in every JVM
            }
        }
        for (Contact contact : snapshot.contacts()) {
            add(contact.timeMicros());
            add(contact.robot());
            add((long) contact.other().hashCode());
        }
    }

    private void add(Pose pose) {
        add(pose.x());
        add(pose.y());
        add(pose.headingRad());
    }

    private void add(double value) {
        add(Double.doubleToRawLongBits(value));
    }

    private void add(long bits) {
        crc.update(ByteBuffer.allocate(Long.BYTES).putLong(bits).flip());
    }

    long value() {
        return crc.getValue();
    }
}
