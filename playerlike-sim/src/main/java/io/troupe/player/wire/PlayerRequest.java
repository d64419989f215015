package io.troupe.player.wire;

/** A request to the player device, which stands for the server itself. */
sealed interface PlayerRequest {
    /** Code of the interface of the player device. */
    int INTERFACE = 1;

    int OPEN = 1;
    int CLOSE = 2;
    int ERROR = 3;

    /** REQ 1: the list of devices. */
    record DeviceList() implements PlayerRequest {}

    /** REQ 2: the driver of a device. */
    record DriverInfo(DeviceAddress device) implements PlayerRequest {}

    /** REQ 3: subscribes to a device, or unsubscribes. */
    record Access(DeviceAddress device, int mode) implements PlayerRequest {}

    /** REQ 4: in pull mode, requests the next data. */
    record NextData() implements PlayerRequest {}

    /** REQ 5: selects push or pull mode. */
    record DataMode(Delivery mode) implements PlayerRequest {}

    /** REQ 10: adds a replace rule. */
    record AddRule(ReplaceRule rule) implements PlayerRequest {}

    /** REQ 255: whether the player device supports a message. */
    record Capability(int type, int subtype) implements PlayerRequest {}

    /** Any other request; always refused. */
    record Other(int subtype) implements PlayerRequest {}
}
