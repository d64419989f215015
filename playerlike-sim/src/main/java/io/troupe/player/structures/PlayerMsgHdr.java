package io.troupe.player.structures;

/** The header of a message. */
public class PlayerMsgHdr {
    private PlayerDevAddr addr = new PlayerDevAddr();
    private byte type;
    private byte subtype;
    private double timestamp;
    private int seq;
    private int size;

    public synchronized PlayerDevAddr getAddr() {
        return addr;
    }

    public synchronized void setAddr(PlayerDevAddr value) {
        addr = value;
    }

    public synchronized byte getType() {
        return type;
    }

    public synchronized void setType(byte value) {
        type = value;
    }

    public synchronized byte getSubtype() {
        return subtype;
    }

    public synchronized void setSubtype(byte value) {
        subtype = value;
    }

    public synchronized double getTimestamp() {
        return timestamp;
    }

    public synchronized void setTimestamp(double value) {
        timestamp = value;
    }

    public synchronized int getSeq() {
        return seq;
    }

    public synchronized void setSeq(int value) {
        seq = value;
    }

    public synchronized int getSize() {
        return size;
    }

    public synchronized void setSize(int value) {
        size = value;
    }
}
