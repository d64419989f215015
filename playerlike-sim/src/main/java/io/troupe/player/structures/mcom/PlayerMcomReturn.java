package io.troupe.player.structures.mcom;

/** Part of a message of the Player interface mcom. This client does not use it. */
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
