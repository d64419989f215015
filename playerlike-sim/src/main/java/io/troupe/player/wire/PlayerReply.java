package io.troupe.player.wire;

import java.util.List;

/** A reply of the player device. */
sealed interface PlayerReply {
    record Ack() implements PlayerReply {}

    record Nack() implements PlayerReply {}

    record DeviceList(List<DeviceAddress> devices) implements PlayerReply {
        public DeviceList {
            devices = List.copyOf(devices);
        }
    }

    record DriverInfo(DeviceAddress device, String driver) implements PlayerReply {}

    /** @param mode the granted access mode, as in {@link PlayerRequest.Access} */
    record Access(DeviceAddress device, int mode, String driver) implements PlayerReply {}
}
