package io.troupe.player;

import io.troupe.player.structures.audiomixer.PlayerAudiomixerCmd;
import io.troupe.player.structures.audiomixer.PlayerAudiomixerConfig;

/**
 * An audio mixer. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface audiomixer.
 */
public class AudioMixerInterface extends UnsupportedDevice {
    public AudioMixerInterface(PlayerClient client) {
        super(client, "audiomixer");
    }

    public void setVolume(int subtype, PlayerAudiomixerCmd value) {
        throw notSupported();
    }

    public void getLevels(byte subtype) {
        throw notSupported();
    }

    public PlayerAudiomixerConfig getConfig() {
        throw notSupported();
    }

    public boolean isConfigReady() {
        throw notSupported();
    }
}
