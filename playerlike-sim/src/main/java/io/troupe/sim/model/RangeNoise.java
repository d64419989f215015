package io.troupe.sim.model;

/**
 * Noise of range readings. Each error is drawn for every reading, uniform within plus or minus half of these.
 *
 * @param constantM independent of the range
 * @param proportional to the range, 0.01 = 1 %
 * @param angularRad in the direction of the ray
 */
public record RangeNoise(double constantM, double proportional, double angularRad) {
    /** Exact readings. */
    public static final RangeNoise NONE = new RangeNoise(0, 0, 0);
}
