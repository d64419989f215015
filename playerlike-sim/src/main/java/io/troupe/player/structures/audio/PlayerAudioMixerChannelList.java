package io.troupe.player.structures.audio;

/** A part of the messages of sound; no device here uses it. */
public class PlayerAudioMixerChannelList {
    private int channels_count;
    private PlayerAudioMixerChannel[] channels = new PlayerAudioMixerChannel[0];

    public synchronized int getChannels_count() {
        return channels_count;
    }

    public synchronized void setChannels_count(int value) {
        channels_count = value;
    }

    public synchronized PlayerAudioMixerChannel[] getChannels() {
        return channels;
    }

    public synchronized void setChannels(PlayerAudioMixerChannel[] value) {
        channels = value;
    }
}
