package io.troupe.player.structures.audio;

/** Part of a message of the Player interface audio. This client does not use it. */
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
