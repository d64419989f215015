package io.troupe.player.wire;

/** A DATA message: the publishing device, the time (in simulated seconds if the server is ours), and the content. */
public record DeviceDataMessage(DeviceAddress from, double timeSeconds, DeviceData data) {}
