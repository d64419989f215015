package io.troupe.services.component.kinds;

import io.troupe.services.behaviour.Blob;
import io.troupe.services.behaviour.LaserScan;
import io.troupe.services.behaviour.RobotPose;
import io.troupe.services.behaviour.SonarRing;
import java.util.List;

/** Input of a behaviour, in the types that control laws use. */
sealed interface BehaviourInput {
    record Position(RobotPose pose, boolean stalled) implements BehaviourInput {}

    record Image(List<Blob> blobs) implements BehaviourInput {}

    record Laser(LaserScan scan) implements BehaviourInput {}

    record Ranges(double timeSeconds, SonarRing sonar) implements BehaviourInput {}
}
