package io.troupe.sim.device;

import io.troupe.sim.model.Pose;

/**
 * Data of the position2d device.
 *
 * @param pose in the odometry frame; heading from -pi to pi
 * @param forwardMps commanded speed along the robot's x axis
 * @param sidewaysMps commanded speed to the left; 0 unless the drive is omnidirectional
 * @param turnRadps commanded turn rate, left positive
 * @param stalled a body touches the robot, and in the last 0.2 s the robot achieved less than half of the commanded
 *     motion
 */
public record Odometry(Pose pose, double forwardMps, double sidewaysMps, double turnRadps, boolean stalled) {
    /** Creates data of a robot that does not move sideways. */
    public Odometry(Pose pose, double forwardMps, double turnRadps, boolean stalled) {
        this(pose, forwardMps, 0, turnRadps, stalled);
    }
}
