package io.troupe.demo.guide;

import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.Velocity;

/** Turns towards a colour and drives to it; gives no command while the camera does not see it. */
final class LightSeeker {
    private LightSeeker() {}

    static Behaviour towards(int colour, double nearM) {
        return senses -> senses.largestBlob(colour).map(light -> {
            double forwardMps = Math.clamp(light.rangeM() - nearM, 0, 0.3);
            return new Velocity(forwardMps, 0.8 * light.offset());
        });
    }
}
