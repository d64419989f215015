package io.troupe.player;

import io.troupe.player.structures.pointcloud3d.PlayerPointCloud3DData;

/**
 * A cloud of points, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface pointcloud3d.
 */
public class PointCloud3DInterface extends UnofferedDevice {
    public PointCloud3DInterface(PlayerClient client) {
        super(client, "pointcloud3d");
    }

    public PlayerPointCloud3DData getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }
}
