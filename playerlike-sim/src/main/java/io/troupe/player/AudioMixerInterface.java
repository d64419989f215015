package io.troupe.player;

import io.troupe.player.structures.audiomixer.PlayerAudiomixerCmd;
import io.troupe.player.structures.audiomixer.PlayerAudiomixerConfig;

/**
 * A sound mixer, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface audiomixer.
 */
public class AudioMixerInterface extends UnofferedDevice {
    public AudioMixerInterface(PlayerClient client) {
        super(client, "audiomixer");
    }

    public void setVolume(int subtype, PlayerAudiomixerCmd value) {
        throw notOffered();
    }

    public void getLevels(byte subtype) {
        throw notOffered();
    }

    public PlayerAudiomixerConfig getConfig() {
        throw notOffered();
    }

    public boolean isConfigReady() {
        throw notOffered();
    }
}
