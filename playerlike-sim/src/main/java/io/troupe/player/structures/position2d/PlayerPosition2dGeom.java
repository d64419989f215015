package io.troupe.player.structures.position2d;

import io.troupe.player.structures.PlayerBbox;
import io.troupe.player.structures.PlayerBbox2d;
import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;

/** Centre and size of the body, in the robot's frame. */
public class PlayerPosition2dGeom {
    private PlayerPose pose = new PlayerPose();
    private PlayerBbox size = new PlayerBbox();

    public synchronized PlayerPose getPose() {
        return pose;
    }

    public synchronized void setPose(PlayerPose2d value) {
        pose = PlayerPose.of(value);
    }

    public synchronized PlayerBbox getSize() {
        return size;
    }

    public synchronized void setSize(PlayerBbox2d value) {
        size = PlayerBbox.of(value);
    }
}
