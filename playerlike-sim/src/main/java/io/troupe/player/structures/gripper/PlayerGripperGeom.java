package io.troupe.player.structures.gripper;

import io.troupe.player.structures.PlayerBbox3d;
import io.troupe.player.structures.PlayerPose3d;

/** Part of a message of the Player interface gripper. */
public class PlayerGripperGeom {
    private PlayerPose3d pose = new PlayerPose3d();
    private PlayerBbox3d innerSize = new PlayerBbox3d();
    private PlayerBbox3d outerSize = new PlayerBbox3d();
    private byte numBeams;
    private byte capacity;

    public synchronized PlayerPose3d getPose() {
        return pose;
    }

    public synchronized void setPose(PlayerPose3d value) {
        pose = value;
    }

    public synchronized PlayerBbox3d getInnerSize() {
        return innerSize;
    }

    public synchronized void setInnerSize(PlayerBbox3d value) {
        innerSize = value;
    }

    public synchronized PlayerBbox3d getOuterSize() {
        return outerSize;
    }

    public synchronized void setOuterSize(PlayerBbox3d value) {
        outerSize = value;
    }

    public synchronized byte getNumBeams() {
        return numBeams;
    }

    public synchronized void setNumBeams(byte value) {
        numBeams = value;
    }

    public synchronized byte getCapacity() {
        return capacity;
    }

    public synchronized void setCapacity(byte value) {
        capacity = value;
    }
}
