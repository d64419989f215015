package io.troupe.player;

import io.troupe.player.structures.pointcloud3d.PlayerPointCloud3DData;

/**
 * 3D point clouds. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface pointcloud3d.
 */
public class PointCloud3DInterface extends UnsupportedDevice {
    public PointCloud3DInterface(PlayerClient client) {
        super(client, "pointcloud3d");
    }

    public PlayerPointCloud3DData getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }
}
