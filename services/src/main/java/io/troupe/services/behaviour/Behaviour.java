package io.troupe.services.behaviour;

import java.util.List;
import java.util.Optional;

/**
 * A control law with its memory, for one robot. A service creates a new one each time it starts to drive the robot.
 *
 * <p><b>Threads.</b> One thread at a time. <b>Order.</b> Called once for each reading, in order of time.
 */
@FunctionalInterface
public interface Behaviour {
    /** Returns the velocity for the robot; empty if this behaviour leaves the robot to the layer below it. */
    Optional<Velocity> step(Senses senses);

    /**
     * Combines layers of control. The first layer that returns a velocity drives the robot; the layers below it are not
     * called in that cycle.
     *
     * <p><b>Source.</b> The subsumption architecture that the paper builds on (its reference 5).
     *
     * @param highestFirst at least one layer
     */
    static Behaviour layers(List<Behaviour> highestFirst) {
        if (highestFirst.isEmpty()) {
            throw new IllegalArgumentException("a behaviour of 0 layers, expected 1 or more");
        }
        var layers = List.copyOf(highestFirst);
        return senses -> {
            for (var layer : layers) {
                var wanted = layer.step(senses);
                if (wanted.isPresent()) {
                    return wanted;
                }
            }
            return Optional.empty();
        };
    }
}
