package io.troupe.player.structures.planner;

import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;

/** A command of the Player interface planner. This client does not use it. */
public class PlayerPlannerCmd {
    private PlayerPose goal = new PlayerPose();

    public synchronized PlayerPose getGoal() {
        return goal;
    }

    public synchronized void setGoal(PlayerPose2d value) {
        goal = PlayerPose.of(value);
    }
}
