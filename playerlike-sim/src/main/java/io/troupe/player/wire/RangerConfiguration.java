package io.troupe.player.wire;

/** How a ranger scans: radians, metres, hertz. */
public record RangerConfiguration(
        double minAngleRad,
        double maxAngleRad,
        double resolutionRad,
        double minRangeM,
        double maxRangeM,
        double rangeResolutionM,
        double frequencyHz) {}
