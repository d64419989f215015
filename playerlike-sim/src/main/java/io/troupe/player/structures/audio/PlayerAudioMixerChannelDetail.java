package io.troupe.player.structures.audio;

/** Part of a message of the Player interface audio. This client does not use it. */
public class PlayerAudioMixerChannelDetail {
    private int name_count;
    private String name = "";
    private byte caps;

    public synchronized int getName_count() {
        return name_count;
    }

    public synchronized void setName_count(int value) {
        name_count = value;
    }

    public synchronized String getName() {
        return name;
    }

    public synchronized void setName(String value) {
        name = value;
    }

    public synchronized byte getCaps() {
        return caps;
    }

    public synchronized void setCaps(byte value) {
        caps = value;
    }
}
