package io.troupe.player.structures.pointcloud3d;

import io.troupe.player.structures.PlayerColor;
import io.troupe.player.structures.PlayerPoint3d;

/** Part of a message of the Player interface pointcloud3d. This client does not use it. */
public class PlayerPointCloud3DElement {
    private PlayerPoint3d point = new PlayerPoint3d();
    private PlayerColor color = new PlayerColor();

    public synchronized PlayerPoint3d getPoint() {
        return point;
    }

    public synchronized void setPoint(PlayerPoint3d value) {
        point = value;
    }

    public synchronized PlayerColor getColor() {
        return color;
    }

    public synchronized void setColor(PlayerColor value) {
        color = value;
    }
}
