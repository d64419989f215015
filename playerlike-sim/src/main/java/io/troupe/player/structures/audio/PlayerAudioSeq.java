package io.troupe.player.structures.audio;

/** A part of the messages of sound; no device here uses it. */
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
