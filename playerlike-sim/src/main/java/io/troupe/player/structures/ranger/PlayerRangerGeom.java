package io.troupe.player.structures.ranger;

import io.troupe.player.structures.PlayerBbox3d;
import io.troupe.player.structures.PlayerPose3d;

/** Poses and sizes of a ranger and its elements, in the robot's frame. */
public class PlayerRangerGeom {
    private PlayerPose3d pose = new PlayerPose3d();
    private PlayerBbox3d size = new PlayerBbox3d();
    private int poses_count;
    private PlayerPose3d[] poses = new PlayerPose3d[0];
    private int sizes_count;
    private PlayerBbox3d[] sizes = new PlayerBbox3d[0];

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

    public synchronized int getPoses_count() {
        return poses_count;
    }

    public synchronized void setPoses_count(int value) {
        poses_count = value;
    }

    public synchronized PlayerPose3d[] getPoses() {
        return poses;
    }

    public synchronized void setPoses(PlayerPose3d[] value) {
        poses = value;
    }

    public synchronized int getSizes_count() {
        return sizes_count;
    }

    public synchronized void setSizes_count(int value) {
        sizes_count = value;
    }

    public synchronized PlayerBbox3d[] getSizes() {
        return sizes;
    }

    public synchronized void setSizes(PlayerBbox3d[] value) {
        sizes = value;
    }
}
