package io.troupe.services.behaviour;

/**
 * What a robot senses at one reading.
 *
 * @param timeSeconds when, on the robot's clock
 * @param pose by its odometry
 */
public record Senses(double timeSeconds, SonarRing sonar, RobotPose pose) {}
