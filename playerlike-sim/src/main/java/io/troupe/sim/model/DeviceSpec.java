package io.troupe.sim.model;

import java.util.List;

/**
 * A device of a robot that {@link RobotSpec#devices} lists.
 *
 * <p><b>Units and shapes.</b> Metres and radians, in the robot's frame. Lengths are x extents, widths y extents.
 */
public sealed interface DeviceSpec {
    /** Player's name of the interface that offers it. */
    String interfaceName();

    /**
     * A finder of {@link Traits#fiducial markers}.
     *
     * @param minRangeM reported to clients only, as in Stage
     * @param maxRangeM markers at this distance or farther are not seen
     * @param maxIdRangeM markers at this distance or farther are seen with the number 0
     * @param fovRad a marker is seen within half of it on both sides of the heading
     * @param key only markers with the same key are seen
     */
    record FiducialFinder(
            Pose mount,
            double minRangeM,
            double maxRangeM,
            double maxIdRangeM,
            double fovRad,
            int key,
            double lengthM,
            double widthM)
            implements DeviceSpec {
        @Override
        public String interfaceName() {
            return "fiducial";
        }
    }

    /** A row of bumpers, each a straight line. */
    record Bumpers(List<Bumper> parts) implements DeviceSpec {
        public Bumpers {
            parts = List.copyOf(parts);
        }

        @Override
        public String interfaceName() {
            return "bumper";
        }
    }

    /**
     * A camera that gives images.
     *
     * @param mount its heading includes the pan angle
     * @param rangeM maximum distance of visible things
     * @param fovRad horizontal field of view
     */
    record Camera(Pose mount, int widthPx, int heightPx, double rangeM, double fovRad, double verticalFovRad)
            implements DeviceSpec {
        @Override
        public String interfaceName() {
            return "camera";
        }
    }

    /**
     * A gripper with two paddles, which takes a grippable thing between them.
     *
     * @param lengthM of the whole gripper, from its base to the tips of the paddles, centred on the mount
     * @param paddleLength share of the length
     * @param paddleWidth thickness of a paddle, as a share of the width
     * @param closed at the start
     * @param snatches it closes by itself while a beam is broken, and opens otherwise
     */
    record Gripper(
            Pose mount,
            double lengthM,
            double widthM,
            double heightM,
            double paddleLength,
            double paddleWidth,
            boolean closed,
            boolean snatches)
            implements DeviceSpec {
        @Override
        public String interfaceName() {
            return "gripper";
        }
    }

    /**
     * One bumper of {@link Bumpers}.
     *
     * @param mount the middle of the line, which is perpendicular to the heading
     */
    record Bumper(Pose mount, double lengthM) {}
}
