package io.troupe.player;

import io.troupe.player.structures.camera.PlayerCameraData;

/**
 * A camera, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
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
