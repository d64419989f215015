package io.troupe.player.wire;

/** Scan configuration of a ranger: radians, metres, hertz. */
public record RangerConfiguration(
        double minAngleRad,
        double maxAngleRad,
        double resolutionRad,
        double minRangeM,
        double maxRangeM,
        double rangeResolutionM,
        double frequencyHz) {}
