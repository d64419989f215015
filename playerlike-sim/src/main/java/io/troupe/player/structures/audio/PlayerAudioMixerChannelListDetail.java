package io.troupe.player.structures.audio;

/** Part of a message of the Player interface audio. This client does not use it. */
public class PlayerAudioMixerChannelListDetail {
    private int details_count;
    private PlayerAudioMixerChannelDetail[] details = new PlayerAudioMixerChannelDetail[0];
    private int defaultOutput;
    private int defaultInput;

    public synchronized int getDetails_count() {
        return details_count;
    }

    public synchronized void setDetails_count(int value) {
        details_count = value;
    }

    public synchronized PlayerAudioMixerChannelDetail[] getDetails() {
        return details;
    }

    public synchronized void setDetails(PlayerAudioMixerChannelDetail[] value) {
        details = value;
    }

    public synchronized int getDefaultOutput() {
        return defaultOutput;
    }

    public synchronized void setDefaultOutput(int value) {
        defaultOutput = value;
    }

    public synchronized int getDefaultInput() {
        return defaultInput;
    }

    public synchronized void setDefaultInput(int value) {
        defaultInput = value;
    }
}
