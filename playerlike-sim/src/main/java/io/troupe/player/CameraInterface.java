package io.troupe.player;

import io.troupe.player.structures.camera.PlayerCameraData;

/**
 * A camera. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface camera.
 */
public class CameraInterface extends UnsupportedDevice {
    public CameraInterface(PlayerClient client) {
        super(client, "camera");
    }

    public void getImage() {
        throw notSupported();
    }

    public PlayerCameraData getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }
}
