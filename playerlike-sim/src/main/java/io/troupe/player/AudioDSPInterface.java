package io.troupe.player;

import io.troupe.player.structures.audiodsp.PlayerAudiodspCmd;
import io.troupe.player.structures.audiodsp.PlayerAudiodspConfig;
import io.troupe.player.structures.audiodsp.PlayerAudiodspData;

/**
 * Audio signal processing. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface audiodsp.
 */
public class AudioDSPInterface extends UnsupportedDevice {
    public AudioDSPInterface(PlayerClient client) {
        super(client, "audiodsp");
    }

    public PlayerAudiodspData getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public PlayerAudiodspConfig getConfig() {
        throw notSupported();
    }

    public boolean isConfigReady() {
        throw notSupported();
    }

    public void playTone(int subtype, PlayerAudiodspCmd value) {
        throw notSupported();
    }

    public void getAudioProperties() {
        throw notSupported();
    }

    public void setAudioProperties(PlayerAudiodspConfig value) {
        throw notSupported();
    }
}
