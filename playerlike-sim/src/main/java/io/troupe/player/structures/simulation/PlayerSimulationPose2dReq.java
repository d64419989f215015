package io.troupe.player.structures.simulation;

import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;

/** The pose of a model, in the world's frame. */
public class PlayerSimulationPose2dReq {
    private String name = "";
    private PlayerPose pose = new PlayerPose();

    public synchronized String getName() {
        return name;
    }

    public synchronized void setName(String value) {
        name = value;
    }

    public synchronized PlayerPose getPose() {
        return pose;
    }

    public synchronized void setPose(PlayerPose2d value) {
        pose = PlayerPose.of(value);
    }
}
