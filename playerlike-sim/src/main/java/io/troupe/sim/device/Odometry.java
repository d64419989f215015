package io.troupe.sim.device;

import io.troupe.sim.scenario.Pose;

/**
 * What position2d reports.
 *
 * @param pose in the odometry frame
 * @param forwardMps commanded speed along the robot's x axis
 * @param turnRadps commanded turn rate, left positive
 * @param stalled something holds the robot back
 */
public record Odometry(Pose pose, double forwardMps, double turnRadps, boolean stalled) {}
