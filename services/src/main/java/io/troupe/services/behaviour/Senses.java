package io.troupe.services.behaviour;

import java.util.Comparator;
import java.util.List;
import java.util.Optional;

/**
 * What a robot senses at one reading.
 *
 * @param timeSeconds when, on the robot's clock; it never goes back, even if that is set back ({@link ReadingTime})
 * @param pose by its odometry
 * @param stalled whether something holds it, so that it does not move as it was told to
 * @param blobs the patches of colour that its camera sees, in the camera's order; empty if there are none
 * @param laser {@link LaserScan#EMPTY} unless the service, or the component, asks for the laser
 */
public record Senses(
        double timeSeconds, SonarRing sonar, RobotPose pose, boolean stalled, List<Blob> blobs, LaserScan laser) {
    public Senses {
        blobs = List.copyOf(blobs);
    }

    /** Without blobs and laser, and not stalled. */
    public Senses(double timeSeconds, SonarRing sonar, RobotPose pose) {
        this(timeSeconds, sonar, pose, false, List.of(), LaserScan.EMPTY);
    }

    /**
     * The blob of a colour with the largest area; of equally large ones the leftmost.
     *
     * @param colour {@code 0x00RRGGBB}
     */
    public Optional<Blob> largestBlob(int colour) {
        return blobs.stream()
                .filter(blob -> blob.colour() == colour)
                .max(Comparator.comparingInt(Blob::areaPx2).thenComparing(Blob::leftPx, Comparator.reverseOrder()));
    }
}
