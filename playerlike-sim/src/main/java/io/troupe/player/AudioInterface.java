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
public class AudioInterface extends UnofferedDevice {
    public AudioInterface(PlayerClient client) {
        super(client, "audio");
    }

    public PlayerAudioWav getWaveformData() {
        throw notOffered();
    }

    public boolean isWaveformDataReady() {
        throw notOffered();
    }

    public PlayerAudioSample getSampleData() {
        throw notOffered();
    }

    public boolean isSampleDataReady() {
        throw notOffered();
    }

    public PlayerAudioSeq getSequenceData() {
        throw notOffered();
    }

    public boolean isSequenceDataReady() {
        throw notOffered();
    }

    public PlayerAudioMixerChannelList getChannelsData() {
        throw notOffered();
    }

    public boolean isChannelsDataReady() {
        throw notOffered();
    }

    public PlayerAudioMixerChannelListDetail getDetailsData() {
        throw notOffered();
    }

    public boolean isDetailsDataReady() {
        throw notOffered();
    }

    public PlayerAudioState getStateData() {
        throw notOffered();
    }

    public boolean isStateDataReady() {
        throw notOffered();
    }

    public void playWaveform(PlayerAudioWav value) {
        throw notOffered();
    }

    public void recordWavStream(int state) {
        throw notOffered();
    }

    public void playSample(int index) {
        throw notOffered();
    }

    public void playSequence(PlayerAudioSeq value) {
        throw notOffered();
    }

    public void mixerChannel(PlayerAudioMixerChannel value) {
        throw notOffered();
    }

    public void mixerMultiChannels(PlayerAudioMixerChannelList value) {
        throw notOffered();
    }

    public void recordWaveform() {
        throw notOffered();
    }

    public void loadSample(PlayerAudioSample value) {
        throw notOffered();
    }

    public void retrieveSample(int index) {
        throw notOffered();
    }

    public void recordSample(int index, int length) {
        throw notOffered();
    }

    public void getMixerDetails() {
        throw notOffered();
    }

    public void getMixerLevels() {
        throw notOffered();
    }
}
