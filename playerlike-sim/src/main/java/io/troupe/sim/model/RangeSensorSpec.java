package io.troupe.sim.model;

/**
 * One sensor of a {@link RangerSpec}: a fan of rays from one point.
 *
 * @param mount sensor pose in the robot's frame
 * @param minRangeM shorter distances are reported as this
 * @param maxRangeM the reading when nothing is hit
 * @param fovRad the angle over which the rays are spread; the first one points to the right end of it, the last one to
 *     the left end
 * @param samples the number of rays; a single one points along the sensor's heading
 * @param lengthM its x extent
 * @param widthM its y extent
 * @param noise none unless the file specifies it
 */
public record RangeSensorSpec(
        Pose mount,
        double minRangeM,
        double maxRangeM,
        double fovRad,
        int samples,
        double lengthM,
        double widthM,
        RangeNoise noise) {}
