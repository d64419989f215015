package io.troupe.player.wire;

/** One DATA message: who says it, when (simulated seconds under our server), and what. */
public record DataMessage(DeviceAddress from, double timeSeconds, DeviceData data) {}
