package io.troupe.player.structures.audiomixer;

/** A request of the Player interface audiomixer. This client does not use it. */
public class PlayerAudiomixerConfig {
    private int master_left;
    private int master_right;
    private int pcm_left;
    private int pcm_right;
    private int line_left;
    private int line_right;
    private int mic_left;
    private int mic_right;
    private int i_gain;
    private int o_gain;

    public synchronized int getMaster_left() {
        return master_left;
    }

    public synchronized void setMaster_left(int value) {
        master_left = value;
    }

    public synchronized int getMaster_right() {
        return master_right;
    }

    public synchronized void setMaster_right(int value) {
        master_right = value;
    }

    public synchronized int getPcm_left() {
        return pcm_left;
    }

    public synchronized void setPcm_left(int value) {
        pcm_left = value;
    }

    public synchronized int getPcm_right() {
        return pcm_right;
    }

    public synchronized void setPcm_right(int value) {
        pcm_right = value;
    }

    public synchronized int getLine_left() {
        return line_left;
    }

    public synchronized void setLine_left(int value) {
        line_left = value;
    }

    public synchronized int getLine_right() {
        return line_right;
    }

    public synchronized void setLine_right(int value) {
        line_right = value;
    }

    public synchronized int getMic_left() {
        return mic_left;
    }

    public synchronized void setMic_left(int value) {
        mic_left = value;
    }

    public synchronized int getMic_right() {
        return mic_right;
    }

    public synchronized void setMic_right(int value) {
        mic_right = value;
    }

    public synchronized int getI_gain() {
        return i_gain;
    }

    public synchronized void setI_gain(int value) {
        i_gain = value;
    }

    public synchronized int getO_gain() {
        return o_gain;
    }

    public synchronized void setO_gain(int value) {
        o_gain = value;
    }
}
