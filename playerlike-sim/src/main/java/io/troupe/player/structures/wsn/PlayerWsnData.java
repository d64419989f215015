package io.troupe.player.structures.wsn;

/** Data of the Player interface wsn. This client does not use it. */
public class PlayerWsnData {
    private int node_type;
    private int node_id;
    private int node_parent_id;
    private PlayerWsnNodeData data_packet = new PlayerWsnNodeData();

    public synchronized int getNode_type() {
        return node_type;
    }

    public synchronized void setNode_type(int value) {
        node_type = value;
    }

    public synchronized int getNode_id() {
        return node_id;
    }

    public synchronized void setNode_id(int value) {
        node_id = value;
    }

    public synchronized int getNode_parent_id() {
        return node_parent_id;
    }

    public synchronized void setNode_parent_id(int value) {
        node_parent_id = value;
    }

    public synchronized PlayerWsnNodeData getData_packet() {
        return data_packet;
    }

    public synchronized void setData_packet(PlayerWsnNodeData value) {
        data_packet = value;
    }
}
