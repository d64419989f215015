package io.troupe.sim;

import io.troupe.sim.device.BlobImage;
import io.troupe.sim.device.DeviceReading;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.model.Pose;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * State and sensor readings of one robot at a tick.
 *
 * @param pose the true pose of the centre of rotation, in the world's frame; heading from -pi to pi
 * @param sonarM one range per sonar, in metres; null if it has no sonar
 * @param blobs null if it has no blobfinder
 * @param rangersM the ranges of all rays of each laser and ranger, in metres
 * @param intensities of the echoes of all rays of each laser and ranger, in the order of {@code rangersM}: an empty
 *     list for those that do not measure them, and none at all if none does; 0 for a ray that hits nothing
 * @param devices those that {@link io.troupe.sim.model.RobotSpec#devices} lists, in this order
 * @param wallGapM from the body's edge to the nearest obstacle that blocks bodies: 0 if they touch or overlap, infinite
 *     if there is none
 */
public record RobotReading(
        Pose pose,
        Odometry odometry,
        @Nullable List<Double> sonarM,
        @Nullable BlobImage blobs,
        List<List<Double>> rangersM,
        List<List<Double>> intensities,
        List<DeviceReading> devices,
        double wallGapM) {
    public RobotReading {
        intensities = List.copyOf(intensities);
        devices = List.copyOf(devices);
    }

    /** Creates the reading of a robot without further devices. */
    public RobotReading(
            Pose pose,
            Odometry odometry,
            @Nullable List<Double> sonarM,
            @Nullable BlobImage blobs,
            List<List<Double>> rangersM,
            double wallGapM) {
        this(pose, odometry, sonarM, blobs, rangersM, List.of(), List.of(), wallGapM);
    }
}
