package io.troupe.services.component.kinds;

import io.troupe.bus.BusTopic;
import io.troupe.services.behaviour.Blob;
import io.troupe.services.behaviour.Velocity;
import java.time.Duration;
import java.util.List;

/**
 * Topics and records of robot data on the bus. Topics are named {@code owner/sonar} and so on, where the owner is a
 * robot ({@code robot1}) or a component that takes part in driving one.
 *
 * <p><b>Units and shapes.</b> Metres, radians, seconds on the robot's clock; x forward, y left, left turns positive.
 * Colours are {@code 0x00RRGGBB}.
 */
public final class RobotTopics {
    /** Ranges of a sonar ring, in the order of the sonars. */
    public record SonarReading(double timeSeconds, List<Double> rangesM) {
        public SonarReading {
            rangesM = List.copyOf(rangesM);
        }
    }

    /** The pose by odometry. */
    public record PositionReading(double timeSeconds, double xM, double yM, double headingRad, boolean stalled) {}

    /** Blobs in the camera image. */
    public record BlobsReading(double timeSeconds, List<Blob> blobs) {
        public BlobsReading {
            blobs = List.copyOf(blobs);
        }
    }

    /**
     * A laser scan from right to left, with equal angles between the beams.
     *
     * @param minBearingRad bearing of the first beam from the laser's axis, left positive
     * @param maxBearingRad bearing of the last beam
     * @param maxRangeM largest range that the laser measures
     */
    public record LaserReading(
            double timeSeconds, double minBearingRad, double maxBearingRad, double maxRangeM, List<Double> rangesM) {
        public LaserReading {
            rangesM = List.copyOf(rangesM);
        }
    }

    /** A colour that has come into sight. */
    public record ColourSeen(double timeSeconds, int colour) {}

    /** The age that a speed may have when it reaches a robot, on all topics that it passes together. */
    private static final Duration MAX_AGE_OF_SPEED = Duration.ofMillis(300);

    /** A control law does not drive by older readings. */
    private static final Duration MAX_AGE_OF_READING = Duration.ofMillis(600);

    private RobotTopics() {}

    public static BusTopic<SonarReading> sonar(String owner) {
        return new BusTopic<>(owner + "/sonar", SonarReading.class).withMaxAge(MAX_AGE_OF_READING);
    }

    public static BusTopic<PositionReading> position(String owner) {
        return new BusTopic<>(owner + "/position", PositionReading.class).withMaxAge(MAX_AGE_OF_READING);
    }

    public static BusTopic<BlobsReading> blobs(String owner) {
        return new BusTopic<>(owner + "/blobs", BlobsReading.class).withMaxAge(MAX_AGE_OF_READING);
    }

    public static BusTopic<LaserReading> laser(String owner) {
        return new BusTopic<>(owner + "/laser", LaserReading.class).withMaxAge(MAX_AGE_OF_READING);
    }

    /** Speeds, of which only the newest counts; one that the bus delivers late is dropped. */
    public static BusTopic<Velocity> velocity(String owner) {
        return new BusTopic<>(owner + "/velocity", Velocity.class)
                .withCapacity(1)
                .withMaxAge(MAX_AGE_OF_SPEED);
    }

    public static BusTopic<ColourSeen> colours(String owner) {
        return new BusTopic<>(owner + "/colours", ColourSeen.class);
    }
}
