package io.troupe.demo.guide;

import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.Velocity;

/** Drives behind a robot of a colour, farther behind a faster one; gives no command while it does not see it. */
final class LeaderFollower {
    private LeaderFollower() {}

    static Behaviour behind(int colour, double gapM) {
        return senses -> senses.largestBlob(colour).map(leader -> {
            double forwardMps = Math.clamp(0.5 * (leader.rangeM() - gapM), -0.2, 0.5);
            return new Velocity(forwardMps, leader.offset());
        });
    }
}
