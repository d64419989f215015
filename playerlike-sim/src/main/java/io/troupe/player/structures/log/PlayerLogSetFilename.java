package io.troupe.player.structures.log;

/** Part of a message of the Player interface log. This client does not use it. */
public class PlayerLogSetFilename {
    private int filename_count;
    private char[] filename = new char[0];

    public synchronized int getFilename_count() {
        return filename_count;
    }

    public synchronized void setFilename_count(int value) {
        filename_count = value;
    }

    public synchronized char[] getFilename() {
        return filename;
    }

    public synchronized void setFilename(char[] value) {
        filename = value;
    }
}
