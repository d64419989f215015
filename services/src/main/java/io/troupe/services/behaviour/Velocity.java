package io.troupe.services.behaviour;

/**
 * The velocity that a behaviour commands.
 *
 * @param forwardMps metres per second along the robot's x axis
 * @param turnRadps radians per second, left positive
 */
public record Velocity(double forwardMps, double turnRadps) {
    public static final Velocity STOP = new Velocity(0, 0);
}
