package io.troupe.player;

import io.troupe.player.structures.audiodsp.PlayerAudiodspCmd;
import io.troupe.player.structures.audiodsp.PlayerAudiodspConfig;
import io.troupe.player.structures.audiodsp.PlayerAudiodspData;

/**
 * A sound processor, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
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
