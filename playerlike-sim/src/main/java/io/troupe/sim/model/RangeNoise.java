package io.troupe.sim.model;

/**
 * Noise of range readings. Each error is drawn for every reading.
 *
 * @param constantM independent of the range
 * @param proportional to the range, 0.01 = 1 %
 * @param angularRad in the direction of the ray
 * @param law how the errors are distributed
 */
public record RangeNoise(double constantM, double proportional, double angularRad, Law law) {
    /** Exact readings. */
    public static final RangeNoise NONE = new RangeNoise(0, 0, 0);

    /** How errors are distributed. */
    public enum Law {
        /** Uniform within plus or minus half of each number. */
        UNIFORM,

        /**
         * As in Stage 4.3, and so that of world files. The constant error is normal, and its variance (not its standard
         * deviation) is {@code constantM}, in square metres. The proportional error is uniform within plus or minus
         * {@code proportional}. The error of the direction is uniform within plus or minus half of {@code angularRad}
         * times the angle between two rays.
         */
        STAGE
    }

    /** Creates uniform noise. */
    public RangeNoise(double constantM, double proportional, double angularRad) {
        this(constantM, proportional, angularRad, Law.UNIFORM);
    }
}
