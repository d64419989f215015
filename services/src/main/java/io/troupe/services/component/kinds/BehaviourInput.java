package io.troupe.services.component.kinds;

import io.troupe.services.behaviour.RobotPose;
import io.troupe.services.behaviour.SonarRing;

/** What a behaviour is told, in the form in which control laws use it. */
sealed interface BehaviourInput {
    record Pose(RobotPose pose) implements BehaviourInput {}

    record Ranges(double timeSeconds, SonarRing sonar) implements BehaviourInput {}
}
