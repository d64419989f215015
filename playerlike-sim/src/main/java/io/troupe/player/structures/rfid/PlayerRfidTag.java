package io.troupe.player.structures.rfid;

/** Part of a message of the Player interface rfid. This client does not use it. */
public class PlayerRfidTag {
    private int type;
    private int guid_count;
    private byte[] guid = new byte[0];

    public synchronized int getType() {
        return type;
    }

    public synchronized void setType(int value) {
        type = value;
    }

    public synchronized int getGuid_count() {
        return guid_count;
    }

    public synchronized void setGuid_count(int value) {
        guid_count = value;
    }

    public synchronized byte[] getGuid() {
        return guid;
    }

    public synchronized void setGuid(byte[] value) {
        guid = value;
    }
}
