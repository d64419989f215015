package io.troupe.sim.model;

import java.util.List;

/**
 * A ring of sonars.
 *
 * @param mounts pose of each sonar in the robot's frame; index = sonar number
 * @param minRangeM shorter distances are reported as this
 * @param maxRangeM the reading when nothing is hit
 * @param fovRad opening angle of one cone (a single ray is cast along the heading, as in Stage)
 */
public record SonarSpec(List<Pose> mounts, double minRangeM, double maxRangeM, double fovRad) {
    public SonarSpec {
        mounts = List.copyOf(mounts);
    }
}
