package io.troupe.player;

import io.troupe.player.structures.stereo.PlayerStereoData;

/**
 * A stereo camera, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface stereo.
 */
public class StereoInterface extends UnofferedDevice {
    public StereoInterface(PlayerClient client) {
        super(client, "stereo");
    }

    public PlayerStereoData getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }
}
