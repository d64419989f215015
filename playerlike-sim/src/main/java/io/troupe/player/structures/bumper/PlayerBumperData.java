package io.troupe.player.structures.bumper;

/** Data of the Player interface bumper. */
public class PlayerBumperData {
    private int bumpers_count;
    private byte[] bumpers = new byte[0];

    public synchronized int getBumpers_count() {
        return bumpers_count;
    }

    public synchronized void setBumpers_count(int value) {
        bumpers_count = value;
    }

    public synchronized byte[] getBumpers() {
        return bumpers;
    }

    public synchronized void setBumpers(byte[] value) {
        bumpers = value;
    }
}
