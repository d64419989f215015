package io.troupe.player.structures.mcom;

/** A request of the Player interface mcom. This client does not use it. */
public class PlayerMcomConfig {
    private int command;
    private int type;
    private int channel_count;
    private int[] channel = new int[0];
    private PlayerMcomData data = new PlayerMcomData();

    public synchronized int getCommand() {
        return command;
    }

    public synchronized void setCommand(int value) {
        command = value;
    }

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
