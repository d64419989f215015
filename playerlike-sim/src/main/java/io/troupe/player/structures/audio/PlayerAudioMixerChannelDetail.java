package io.troupe.player.structures.audio;

/** A part of the messages of sound; no device here uses it. */
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
