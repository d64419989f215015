package io.troupe.player.wire;

import java.util.List;

/**
 * All that a server publishes to one client at one tick, in the order position2d, sonar, blobfinder per robot.
 *
 * @param tick counts publications from 0
 */
public record Frame(long tick, double timeSeconds, List<DataMessage> messages) {
    public Frame {
        messages = List.copyOf(messages);
    }
}
