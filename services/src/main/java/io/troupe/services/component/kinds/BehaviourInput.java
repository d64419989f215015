package io.troupe.services.component.kinds;

import io.troupe.services.behaviour.Blob;
import io.troupe.services.behaviour.LaserScan;
import io.troupe.services.behaviour.RobotPose;
import io.troupe.services.behaviour.SonarRing;
import java.util.List;

/** What a behaviour is told, in the form in which control laws use it. */
sealed interface BehaviourInput {
    record Position(RobotPose pose, boolean stalled) implements BehaviourInput {}

    record Image(List<Blob> blobs) implements BehaviourInput {}

    record Laser(LaserScan scan) implements BehaviourInput {}

    record Ranges(double timeSeconds, SonarRing sonar) implements BehaviourInput {}
}
