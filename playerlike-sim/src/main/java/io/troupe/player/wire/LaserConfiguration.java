package io.troupe.player.wire;

/** Scan configuration of a laser: radians, metres, hertz. */
public record LaserConfiguration(
        float minAngleRad,
        float maxAngleRad,
        float resolutionRad,
        float maxRangeM,
        float rangeResolutionM,
        boolean intensities,
        float frequencyHz) {
    public LaserConfiguration withIntensities(boolean on) {
        return new LaserConfiguration(
                minAngleRad, maxAngleRad, resolutionRad, maxRangeM, rangeResolutionM, on, frequencyHz);
    }
}
