package io.troupe.player.wire;

/** How a laser scans: radians, metres, hertz. */
public record LaserConfiguration(
        float minAngleRad,
        float maxAngleRad,
        float resolutionRad,
        float maxRangeM,
        float rangeResolutionM,
        boolean intensities,
        float frequencyHz) {}
