package io.troupe.sim;

import io.troupe.sim.physics.Touches;
import io.troupe.sim.scenario.WorldSpec;
import java.util.List;
import java.util.stream.IntStream;

/** Touches of the physics in the words of the world. */
final class Contacts {
    private Contacts() {}

    static List<Contact> of(Touches touches, WorldSpec spec) {
        return IntStream.range(0, touches.count())
                .mapToObj(i -> {
                    int otherRobot = touches.otherRobot(i);
                    String other = otherRobot >= 0
                            ? spec.robots().get(otherRobot).name()
                            : spec.obstacles().get(touches.obstacle(i)).name();
                    return new Contact(touches.timeMicros(i), touches.robot(i), other, otherRobot);
                })
                .toList();
    }
}
