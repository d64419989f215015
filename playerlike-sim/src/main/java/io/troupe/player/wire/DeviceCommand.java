package io.troupe.player.wire;

/** The content of a CMD message. */
public sealed interface DeviceCommand {
    /** position2d CMD 1: metres and radians per second in the robot's frame; Stage ignores {@code enabled}. */
    record Velocity(double vx, double vy, double va, boolean enabled) implements DeviceCommand {}

    /** position2d CMD 2: a goal in the odometry frame. Stage ignores the speeds on the way and {@code enabled}. */
    record GoTo(double px, double py, double pa, double vx, double vy, double va, boolean enabled)
            implements DeviceCommand {}

    /** position2d CMD 3. */
    record Car(double velocityMps, double angleRad) implements DeviceCommand {}

    /** position2d CMD 4: the heading is absolute, in the odometry frame. */
    record VelocityHeading(double velocityMps, double headingRad) implements DeviceCommand {}

    /**
     * gripper CMD 1 to 5.
     *
     * @param order Player's number of it: also 3 stop, 4 store, 5 retrieve
     */
    record Gripper(int order) implements DeviceCommand {
        /** Value of {@link #order}. */
        public static final int OPEN = 1;
        /** Value of {@link #order}. */
        public static final int CLOSE = 2;
    }

    /** simulation CMD 1: pauses the world, or continues it. */
    record Pause() implements DeviceCommand {}

    /** simulation CMD 2: resets every model to its start pose. */
    record Reset() implements DeviceCommand {}

    /** simulation CMD 3: saves the world. */
    record Save() implements DeviceCommand {}
}
