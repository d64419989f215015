package io.troupe.player.structures.health;

/** Part of a message of the Player interface health. This client does not use it. */
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
