package io.troupe.sim.model;

/**
 * What only some devices notice of a thing.
 *
 * @param fiducial number of the marker that {@link DeviceSpec.FiducialFinder} sees, 0 = none ({@code fiducial_return})
 * @param fiducialKey key of the marker ({@code fiducial_key})
 * @param reflectance intensity of the echo of a laser or ranger ({@code ranger_return} in Stage 4; in the classic
 *     dialect 1 for a bright thing, whose {@code laser_return} is 2, and 0 for others)
 * @param grippable grippers can take an obstacle ({@code gripper_return})
 * @param pushableKg mass of an obstacle that robots can push; 0 = it stands still, unless a gripper takes it
 */
public record Traits(int fiducial, int fiducialKey, double reflectance, boolean grippable, double pushableKg) {
    /** Nothing of that. */
    public static final Traits PLAIN = new Traits(0, 0, 0, false, 0);
}
