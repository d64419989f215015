package io.troupe.player.wire;

import java.util.List;

/**
 * The data that a server publishes to one client in one tick, per robot in the order position2d, sonar, blobfinder.
 *
 * @param tick number of the publication, from 0
 */
public record Frame(long tick, double timeSeconds, List<DeviceDataMessage> messages) {
    public Frame {
        messages = List.copyOf(messages);
    }
}
