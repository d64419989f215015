package io.troupe.services.behaviour;

import java.util.Comparator;
import java.util.List;
import java.util.Optional;

/**
 * The sensor data of one reading.
 *
 * @param timeSeconds time of the reading on the robot's clock, made monotonic by {@link ReadingTime}
 * @param pose by odometry
 * @param stalled whether the robot is blocked, so that it cannot move as commanded
 * @param blobs colour patches that the camera sees, in the camera's order; may be empty
 * @param laser {@link LaserScan#EMPTY} unless the service, or the component, uses the laser
 */
public record Senses(
        double timeSeconds, SonarRing sonar, RobotPose pose, boolean stalled, List<Blob> blobs, LaserScan laser) {
    public Senses {
        blobs = Blob.copyOf(blobs);
    }

    /** Creates senses without blobs and laser, not stalled. */
    public Senses(double timeSeconds, SonarRing sonar, RobotPose pose) {
        this(timeSeconds, sonar, pose, false, List.of(), LaserScan.EMPTY);
    }

    /**
     * The largest blob of a colour; of equally large ones the leftmost.
     *
     * @param colour {@code 0x00RRGGBB}
     */
    public Optional<Blob> largestBlob(int colour) {
        return blobs.stream()
                .filter(blob -> blob.colour() == colour)
                .max(Comparator.comparingInt(Blob::areaPx2).thenComparing(Blob::leftPx, Comparator.reverseOrder()));
    }
}
