package io.troupe.sim.scenario;

import java.util.List;

/**
 * A ranging device: a laser scanner, or what the Stage 4 dialect calls a ranger.
 *
 * @param kind by which interface it is offered
 * @param mount where it sits, in the robot's frame
 * @param lengthM its x extent
 * @param widthM its y extent
 * @param sensors whose ranges it publishes one after the other; 1 for a laser
 */
public record RangerSpec(Kind kind, Pose mount, double lengthM, double widthM, List<RangeSensorSpec> sensors) {
    /** The two ways in which a ranging device is offered. */
    public enum Kind {
        /** Player's {@code laser}: a scan in one plane from one place. */
        LASER,
        /** Player's {@code ranger}: any number of sensors. */
        RANGER
    }

    public RangerSpec {
        sensors = List.copyOf(sensors);
    }
}
