package io.troupe.player;

import io.troupe.player.structures.stereo.PlayerStereoData;

/**
 * A stereo camera. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface stereo.
 */
public class StereoInterface extends UnsupportedDevice {
    public StereoInterface(PlayerClient client) {
        super(client, "stereo");
    }

    public PlayerStereoData getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }
}
