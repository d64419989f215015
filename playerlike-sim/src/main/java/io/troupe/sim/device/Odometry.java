package io.troupe.sim.device;

import io.troupe.sim.scenario.Pose;

/**
 * What position2d reports.
 *
 * @param pose in the odometry frame; heading from -pi to pi
 * @param forwardMps commanded speed along the robot's x axis
 * @param turnRadps commanded turn rate, left positive
 * @param stalled something touches the robot and has kept it from half of what it was told to do in the last 0.2 s
 */
public record Odometry(Pose pose, double forwardMps, double turnRadps, boolean stalled) {}
