package io.troupe.sim;

import io.troupe.sim.device.BlobImage;
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
 * @param wallGapM from the body's edge to the nearest obstacle that blocks bodies: 0 if they touch or overlap, infinite
 *     if there is none
 */
public record RobotReading(
        Pose pose,
        Odometry odometry,
        @Nullable List<Double> sonarM,
        @Nullable BlobImage blobs,
        List<List<Double>> rangersM,
        double wallGapM) {}
