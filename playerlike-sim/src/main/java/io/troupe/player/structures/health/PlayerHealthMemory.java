package io.troupe.player.structures.health;

/** A part of the messages of the load of a machine; no device here uses it. */
public class PlayerHealthMemory {
    private long total;
    private long used;
    private long free;

    public synchronized long getTotal() {
        return total;
    }

    public synchronized void setTotal(long value) {
        total = value;
    }

    public synchronized long getUsed() {
        return used;
    }

    public synchronized void setUsed(long value) {
        used = value;
    }

    public synchronized long getFree() {
        return free;
    }

    public synchronized void setFree(long value) {
        free = value;
    }
}
