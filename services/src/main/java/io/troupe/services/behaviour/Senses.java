package io.troupe.services.behaviour;

/**
 * What a robot senses at one reading.
 *
 * @param timeSeconds when, on the robot's clock; it never goes back, even if that is set back ({@link ReadingTime})
 * @param pose by its odometry
 */
public record Senses(double timeSeconds, SonarRing sonar, RobotPose pose) {}
