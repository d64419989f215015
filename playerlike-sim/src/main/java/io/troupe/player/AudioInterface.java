package io.troupe.player;

import io.troupe.player.structures.audio.PlayerAudioMixerChannel;
import io.troupe.player.structures.audio.PlayerAudioMixerChannelList;
import io.troupe.player.structures.audio.PlayerAudioMixerChannelListDetail;
import io.troupe.player.structures.audio.PlayerAudioSample;
import io.troupe.player.structures.audio.PlayerAudioSeq;
import io.troupe.player.structures.audio.PlayerAudioState;
import io.troupe.player.structures.audio.PlayerAudioWav;

/**
 * Audio. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface audio.
 */
public class AudioInterface extends UnsupportedDevice {
    public AudioInterface(PlayerClient client) {
        super(client, "audio");
    }

    public PlayerAudioWav getWaveformData() {
        throw notSupported();
    }

    public boolean isWaveformDataReady() {
        throw notSupported();
    }

    public PlayerAudioSample getSampleData() {
        throw notSupported();
    }

    public boolean isSampleDataReady() {
        throw notSupported();
    }

    public PlayerAudioSeq getSequenceData() {
        throw notSupported();
    }

    public boolean isSequenceDataReady() {
        throw notSupported();
    }

    public PlayerAudioMixerChannelList getChannelsData() {
        throw notSupported();
    }

    public boolean isChannelsDataReady() {
        throw notSupported();
    }

    public PlayerAudioMixerChannelListDetail getDetailsData() {
        throw notSupported();
    }

    public boolean isDetailsDataReady() {
        throw notSupported();
    }

    public PlayerAudioState getStateData() {
        throw notSupported();
    }

    public boolean isStateDataReady() {
        throw notSupported();
    }

    public void playWaveform(PlayerAudioWav value) {
        throw notSupported();
    }

    public void recordWavStream(int state) {
        throw notSupported();
    }

    public void playSample(int index) {
        throw notSupported();
    }

    public void playSequence(PlayerAudioSeq value) {
        throw notSupported();
    }

    public void mixerChannel(PlayerAudioMixerChannel value) {
        throw notSupported();
    }

    public void mixerMultiChannels(PlayerAudioMixerChannelList value) {
        throw notSupported();
    }

    public void recordWaveform() {
        throw notSupported();
    }

    public void loadSample(PlayerAudioSample value) {
        throw notSupported();
    }

    public void retrieveSample(int index) {
        throw notSupported();
    }

    public void recordSample(int index, int length) {
        throw notSupported();
    }

    public void getMixerDetails() {
        throw notSupported();
    }

    public void getMixerLevels() {
        throw notSupported();
    }
}
