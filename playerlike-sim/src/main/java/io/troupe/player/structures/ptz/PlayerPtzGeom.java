package io.troupe.player.structures.ptz;

import io.troupe.player.structures.PlayerBbox3d;
import io.troupe.player.structures.PlayerPose3d;

/** A part of the messages of a camera that pans, tilts and zooms; no device here uses it. */
public class PlayerPtzGeom {
    private PlayerPose3d pose = new PlayerPose3d();
    private PlayerBbox3d size = new PlayerBbox3d();

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
}
