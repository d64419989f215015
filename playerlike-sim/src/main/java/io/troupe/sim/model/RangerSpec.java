package io.troupe.sim.model;

import java.util.List;

/**
 * A ranging device: a laser scanner, or a ranger of the Stage 4 dialect.
 *
 * @param kind the interface by which it is offered
 * @param mount device pose in the robot's frame
 * @param lengthM its x extent
 * @param widthM its y extent
 * @param sensors in the order in which their ranges are published; 1 for a laser
 * @param intensities it measures the intensities of echoes from the start
 */
public record RangerSpec(
        Kind kind, Pose mount, double lengthM, double widthM, List<RangeSensorSpec> sensors, boolean intensities) {
    /** The interface of a ranging device. */
    public enum Kind {
        /** Player's {@code laser}: a scan in one plane from one point. */
        LASER,
        /** Player's {@code ranger}: any number of sensors. */
        RANGER
    }

    public RangerSpec {
        sensors = List.copyOf(sensors);
    }

    /** Creates a device without intensities. */
    public RangerSpec(Kind kind, Pose mount, double lengthM, double widthM, List<RangeSensorSpec> sensors) {
        this(kind, mount, lengthM, widthM, sensors, false);
    }
}
