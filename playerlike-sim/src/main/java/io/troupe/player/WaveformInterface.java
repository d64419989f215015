package io.troupe.player;

import io.troupe.player.structures.waveform.PlayerWaveformData;

/**
 * A source of waveforms, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface waveform.
 */
public class WaveformInterface extends UnofferedDevice {
    public WaveformInterface(PlayerClient client) {
        super(client, "waveform");
    }

    public PlayerWaveformData getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }
}
