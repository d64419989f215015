package io.troupe.player.structures.mcom;

/** A part of the messages of a store of messages between clients; no device here uses it. */
public class PlayerMcomReturn {
    private int type;
    private int channel_count;
    private int[] channel = new int[0];
    private PlayerMcomData data = new PlayerMcomData();

    public synchronized int getType() {
        return type;
    }

    public synchronized void setType(int value) {
        type = value;
    }

    public synchronized int getChannel_count() {
        return channel_count;
    }

    public synchronized void setChannel_count(int value) {
        channel_count = value;
    }

    public synchronized int[] getChannel() {
        return channel;
    }

    public synchronized void setChannel(int[] value) {
        channel = value;
    }

    public synchronized PlayerMcomData getData() {
        return data;
    }

    public synchronized void setData(PlayerMcomData value) {
        data = value;
    }
}
