package io.troupe.services.behaviour;

/**
 * Where a robot believes it is.
 *
 * @param headingRad from the x axis, left positive
 */
public record RobotPose(double xM, double yM, double headingRad) {}
