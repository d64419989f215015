package io.troupe.services.subsumption;

/**
 * A behaviour that can be put in charge of a robot.
 *
 * @param name as printed
 * @param findsColours whether the robot looks for colours meanwhile, so that it can change the state
 */
public record Service(String name, boolean findsColours) {
    /** Paper, section 3.1. */
    public static final Service WALL_FOLLOWER = new Service("wallFollower", false);
    /** Paper, section 3.2, with its colour finder. */
    public static final Service SPACE_WANDERER = new Service("spaceWanderer", true);

    @Override
    public String toString() {
        return name;
    }
}
