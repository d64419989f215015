package io.troupe.player;

import io.troupe.player.structures.waveform.PlayerWaveformData;

/**
 * Waveforms. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface waveform.
 */
public class WaveformInterface extends UnsupportedDevice {
    public WaveformInterface(PlayerClient client) {
        super(client, "waveform");
    }

    public PlayerWaveformData getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }
}
