package io.troupe.sim.physics;

/**
 * Two bodies began to touch.
 *
 * @param timeMicros end of the physics step
 * @param robot the robot; of two robots the one with the lower index
 * @param otherRobot index of the other robot, or -1
 * @param obstacle index of the obstacle, or -1
 */
public record Touch(long timeMicros, int robot, int otherRobot, int obstacle) {}
