package io.troupe.player.wire;

/** The content of a CMD message. */
public sealed interface DeviceCommand {
    /** position2d CMD 1: metres and radians per second in the robot's frame; a false {@code enabled} stops the motors. */
    record Velocity(double vx, double vy, double va, boolean enabled) implements DeviceCommand {}
}
