package io.troupe.services.behaviour;

/**
 * A robot's position and heading by its odometry.
 *
 * @param headingRad from the x axis, left positive
 */
public record RobotPose(double xM, double yM, double headingRad) {}
