package io.troupe.player.wire;

import java.util.List;

/** What a device answers. */
public sealed interface DeviceReply {
    /** Done (RESP_ACK without content). */
    record Ack() implements DeviceReply {}

    /** Refused (RESP_NACK), and why, where the server says so. */
    record Nack(String reason) implements DeviceReply {}

    /** The body in the robot's frame: its centre, its length (x) and width (y), metres and radians. */
    record Position2dGeometry(double px, double py, double pa, double lengthM, double widthM) implements DeviceReply {}

    /** Where each sonar sits, in the robot's frame. */
    record SonarGeometry(List<SonarMount> mounts) implements DeviceReply {
        public SonarGeometry {
            mounts = List.copyOf(mounts);
        }
    }

    /** Metres and radians, in the robot's frame. */
    record SonarMount(double px, double py, double yaw) {}
}
