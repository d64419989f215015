package io.troupe.player.structures.pointcloud3d;

/** Data of the Player interface pointcloud3d. This client does not use it. */
public class PlayerPointCloud3DData {
    private int points_count;
    private PlayerPointCloud3DElement[] points = new PlayerPointCloud3DElement[0];

    public synchronized int getPoints_count() {
        return points_count;
    }

    public synchronized void setPoints_count(int value) {
        points_count = value;
    }

    public synchronized PlayerPointCloud3DElement[] getPoints() {
        return points;
    }

    public synchronized void setPoints(PlayerPointCloud3DElement[] value) {
        points = value;
    }
}
