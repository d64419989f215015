package io.troupe.player.wire;

/** The content of a REQ message to a device; each has exactly one {@link DeviceReply}. */
public sealed interface DeviceRequest {
    /** position2d REQ 1, sonar REQ 1. */
    record Geometry() implements DeviceRequest {}

    /** position2d REQ 2, sonar REQ 2. */
    record Power(boolean on) implements DeviceRequest {}

    /** position2d REQ 6. */
    record ResetOdometry() implements DeviceRequest {}

    /** position2d REQ 5: metres, radians. */
    record SetOdometry(double px, double py, double pa) implements DeviceRequest {}
}
