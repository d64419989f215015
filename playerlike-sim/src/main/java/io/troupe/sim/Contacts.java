package io.troupe.sim;

import io.troupe.sim.physics.Touches;
import io.troupe.sim.scenario.WorldSpec;
import java.util.List;
import java.util.stream.IntStream;

/** Converts the touches of the physics, which have indices, to contacts with names. */
final class Contacts {
    private Contacts() {}

    /** @param startMicros simulated time at which the physics began to count its own */
    static List<Contact> of(Touches touches, WorldSpec spec, long startMicros) {
        return IntStream.range(0, touches.count())
                .mapToObj(i -> {
                    int otherRobot = touches.otherRobot(i);
                    String other = otherRobot >= 0
                            ? spec.robots().get(otherRobot).name()
                            : spec.obstacles().get(touches.obstacle(i)).name();
                    return new Contact(startMicros + touches.timeMicros(i), touches.robot(i), other, otherRobot);
                })
                .toList();
    }
}
