package io.troupe.sim.scenario;

/**
 * By how much readings of a range are off: each is drawn anew, evenly from plus or minus half of these.
 *
 * @param constantM independent of the range
 * @param proportional to the range, 0.01 = 1 %
 * @param angularRad in the direction of the ray
 */
public record RangeNoise(double constantM, double proportional, double angularRad) {
    /** Exact readings. */
    public static final RangeNoise NONE = new RangeNoise(0, 0, 0);
}
