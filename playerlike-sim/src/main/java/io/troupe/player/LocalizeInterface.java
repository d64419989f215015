package io.troupe.player;

import io.troupe.player.structures.localize.PlayerLocalizeData;
import io.troupe.player.structures.localize.PlayerLocalizeGetParticles;
import io.troupe.player.structures.localize.PlayerLocalizeSetPose;

/**
 * Localization. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface localize.
 */
public class LocalizeInterface extends UnsupportedDevice {
    public LocalizeInterface(PlayerClient client) {
        super(client, "localize");
    }

    public void setPose(PlayerLocalizeSetPose value) {
        throw notSupported();
    }

    public void queryParticles() {
        throw notSupported();
    }

    public PlayerLocalizeData getData() {
        throw notSupported();
    }

    public PlayerLocalizeGetParticles getParticleData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public boolean isParticleDataReady() {
        throw notSupported();
    }
}
