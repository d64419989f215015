package io.troupe.player.structures.fiducial;

import io.troupe.player.structures.PlayerBbox;
import io.troupe.player.structures.PlayerBbox2d;
import io.troupe.player.structures.PlayerBbox3d;
import io.troupe.player.structures.PlayerPose3d;

/** Part of a message of the Player interface fiducial. */
public class PlayerFiducialGeom {
    private PlayerPose3d pose = new PlayerPose3d();
    private PlayerBbox3d size = new PlayerBbox3d();
    private PlayerBbox fiducial_size = new PlayerBbox();

    public synchronized PlayerPose3d getPose() {
        return pose;
    }

    public synchronized void setPose(PlayerPose3d value) {
        pose = value;
    }

    public synchronized PlayerBbox3d getSize() {
        return size;
    }

    public synchronized void setSize(PlayerBbox3d value) {
        size = value;
    }

    public synchronized PlayerBbox getFiducial_size() {
        return fiducial_size;
    }

    public synchronized void setFiducial_size(PlayerBbox2d value) {
        fiducial_size = PlayerBbox.of(value);
    }
}
