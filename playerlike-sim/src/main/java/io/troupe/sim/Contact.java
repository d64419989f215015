package io.troupe.sim;

/**
 * Two bodies began to touch; reported once, however long they go on.
 *
 * @param timeMicros simulated time at the end of the physics step
 * @param robot index of the robot, from 0; of two robots the lower index
 * @param other what it touched: another robot's or an obstacle's name
 * @param otherRobot index of the other robot, or -1 for an obstacle
 */
public record Contact(long timeMicros, int robot, String other, int otherRobot) {}
