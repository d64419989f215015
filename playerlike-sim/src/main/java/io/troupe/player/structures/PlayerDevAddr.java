package io.troupe.player.structures;

/** The address of a device: host and robot (the port) as sent by the server, interface code and index. */
public class PlayerDevAddr {
    private int host;
    private int robot;
    private short interf;
    private short index;

    public synchronized int getHost() {
        return host;
    }

    public synchronized void setHost(int value) {
        host = value;
    }

    public synchronized int getRobot() {
        return robot;
    }

    public synchronized void setRobot(int value) {
        robot = value;
    }

    public synchronized short getInterf() {
        return interf;
    }

    public synchronized void setInterf(short value) {
        interf = value;
    }

    public synchronized short getIndex() {
        return index;
    }

    public synchronized void setIndex(short value) {
        index = value;
    }
}
