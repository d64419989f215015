package io.troupe.sim;

/**
 * Two bodies began to touch.
 *
 * @param timeMicros simulated time of the physics step
 * @param robot index of the robot, from 0
 * @param other what it touched: another robot's or an obstacle's name
 * @param otherRobot index of the other robot, or -1 for an obstacle
 */
public record Contact(long timeMicros, int robot, String other, int otherRobot) {}
