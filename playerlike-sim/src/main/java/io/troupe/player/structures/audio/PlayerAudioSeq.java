package io.troupe.player.structures.audio;

/** Part of a message of the Player interface audio. This client does not use it. */
public class PlayerAudioSeq {
    private int tones_count;
    private PlayerAudioSeqItem[] tones = new PlayerAudioSeqItem[0];

    public synchronized int getTones_count() {
        return tones_count;
    }

    public synchronized void setTones_count(int value) {
        tones_count = value;
    }

    public synchronized PlayerAudioSeqItem[] getTones() {
        return tones;
    }

    public synchronized void setTones(PlayerAudioSeqItem[] value) {
        tones = value;
    }
}
