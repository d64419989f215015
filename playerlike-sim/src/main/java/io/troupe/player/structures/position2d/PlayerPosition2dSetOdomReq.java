package io.troupe.player.structures.position2d;

import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;

/** A request of the Player interface position2d, named as in the original client. */
public class PlayerPosition2dSetOdomReq {
    private PlayerPose pose = new PlayerPose();

    public synchronized PlayerPose getPose() {
        return pose;
    }

    public synchronized void setPose(PlayerPose2d value) {
        pose = PlayerPose.of(value);
    }
}
