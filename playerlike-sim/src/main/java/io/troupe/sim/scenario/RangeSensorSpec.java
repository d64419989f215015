package io.troupe.sim.scenario;

/**
 * One sensor of a {@link RangerSpec}: a fan of rays from one place.
 *
 * @param mount where it sits and looks, in the robot's frame
 * @param minRangeM what is nearer cannot be told
 * @param maxRangeM the reading when nothing is hit
 * @param fovRad the angle over which the rays are spread; the first one points to the right end of it, the last one to
 *     the left end
 * @param samples the number of rays; a single one points where the sensor looks
 * @param lengthM its x extent
 * @param widthM its y extent
 * @param noise off unless the file asks for it
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
