package io.troupe.player.wire;

/** A request to the player device, which is the server itself. */
sealed interface PlayerRequest {
    /** Interface and index of the player device. */
    int INTERFACE = 1;

    int OPEN = 1;
    int CLOSE = 2;
    int ERROR = 3;

    /** REQ 1. */
    record DeviceList() implements PlayerRequest {}

    /** REQ 2. */
    record DriverInfo(DeviceAddress device) implements PlayerRequest {}

    /** REQ 3. */
    record Access(DeviceAddress device, int mode) implements PlayerRequest {}

    /** REQ 4: in pull mode the client wants its next data. */
    record NextData() implements PlayerRequest {}

    /** REQ 5. */
    record DataMode(Delivery mode) implements PlayerRequest {}

    /** REQ 10. */
    record AddRule(ReplaceRule rule) implements PlayerRequest {}

    /** REQ 255: whether a message would be understood. */
    record Capability(int type, int subtype) implements PlayerRequest {}

    /** Refused, whatever it says. */
    record Other(int subtype) implements PlayerRequest {}
}
