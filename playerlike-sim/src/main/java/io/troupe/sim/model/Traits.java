package io.troupe.sim.model;

/**
 * What only some devices notice of a thing.
 *
 * @param fiducial number of the marker that {@link DeviceSpec.FiducialFinder} sees, 0 = none ({@code fiducial_return})
 * @param fiducialKey key of the marker ({@code fiducial_key})
 */
public record Traits(int fiducial, int fiducialKey) {
    /** Nothing of that. */
    public static final Traits PLAIN = new Traits(0, 0);
}
