package io.troupe.services.behaviour;

import java.util.List;
import java.util.Optional;

/**
 * A control law with its memory, for one robot: made anew each time its service takes charge.
 *
 * <p><b>Threads.</b> One at a time. <b>Order.</b> Called once for each reading, in the order of their times.
 */
@FunctionalInterface
public interface Behaviour {
    /** What it wants the robot to do; empty if it has nothing to say now and leaves the robot to the layer below it. */
    Optional<Velocity> step(Senses senses);

    /**
     * Layers of control: the first that wants something drives the robot, and those below it are not asked.
     *
     * <p><b>Source.</b> The subsumption architecture that the paper builds on (its reference 5).
     *
     * @param highestFirst at least one
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
