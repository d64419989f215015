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
public class AudioDSPInterface extends UnofferedDevice {
    public AudioDSPInterface(PlayerClient client) {
        super(client, "audiodsp");
    }

    public PlayerAudiodspData getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }

    public PlayerAudiodspConfig getConfig() {
        throw notOffered();
    }

    public boolean isConfigReady() {
        throw notOffered();
    }

    public void playTone(int subtype, PlayerAudiodspCmd value) {
        throw notOffered();
    }

    public void getAudioProperties() {
        throw notOffered();
    }

    public void setAudioProperties(PlayerAudiodspConfig value) {
        throw notOffered();
    }
}
