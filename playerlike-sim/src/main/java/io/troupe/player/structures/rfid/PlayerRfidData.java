package io.troupe.player.structures.rfid;

/** Data of the Player interface rfid. This client does not use it. */
public class PlayerRfidData {
    private int tags_count;
    private PlayerRfidTag[] tags = new PlayerRfidTag[0];

    public synchronized int getTags_count() {
        return tags_count;
    }

    public synchronized void setTags_count(int value) {
        tags_count = value;
    }

    public synchronized PlayerRfidTag[] getTags() {
        return tags;
    }

    public synchronized void setTags(PlayerRfidTag[] value) {
        tags = value;
    }
}
