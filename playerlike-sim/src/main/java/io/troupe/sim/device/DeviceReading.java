package io.troupe.sim.device;

import java.util.List;

/**
 * The reading of a device that {@link io.troupe.sim.model.RobotSpec#devices} lists; immutable.
 *
 * <p><b>Units and shapes.</b> Metres and radians.
 */
public sealed interface DeviceReading {
    /** The markers that a fiducial finder sees: first those of obstacles, then of robots, in the order of the file. */
    record Fiducials(List<Fiducial> seen) implements DeviceReading {
        public Fiducials {
            seen = List.copyOf(seen);
        }
    }

    /**
     * A marker, as seen from the finder.
     *
     * @param id its number; 0 if it is too far away for the number to be read
     * @param x ahead of the finder
     * @param y left of it
     * @param headingRad of the thing with the marker, relative to the finder's heading; from -pi to pi
     */
    record Fiducial(int id, double x, double y, double headingRad) {}

    /** Whether something presses each bumper of a row. */
    record Pressed(List<Boolean> bumpers) implements DeviceReading {
        public Pressed {
            bumpers = List.copyOf(bumpers);
        }
    }
}
