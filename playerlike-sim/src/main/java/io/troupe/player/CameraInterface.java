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
public class CameraInterface extends UnofferedDevice {
    public CameraInterface(PlayerClient client) {
        super(client, "camera");
    }

    public void getImage() {
        throw notOffered();
    }

    public PlayerCameraData getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }
}
