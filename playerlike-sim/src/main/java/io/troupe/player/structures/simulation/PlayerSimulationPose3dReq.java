package io.troupe.player.structures.simulation;

import io.troupe.player.structures.PlayerPose3d;

/** A request of the Player interface simulation, named as in the original client. */
public class PlayerSimulationPose3dReq {
    private int name_count;
    private char[] name = new char[0];
    private PlayerPose3d pose = new PlayerPose3d();
    private double simtime;

    public synchronized int getName_count() {
        return name_count;
    }

    public synchronized void setName_count(int value) {
        name_count = value;
    }

    public synchronized char[] getName() {
        return name;
    }

    public synchronized void setName(char[] value) {
        name = value;
    }

    public synchronized PlayerPose3d getPose() {
        return pose;
    }

    public synchronized void setPose(PlayerPose3d value) {
        pose = value;
    }

    public synchronized double getSimtime() {
        return simtime;
    }

    public synchronized void setSimtime(double value) {
        simtime = value;
    }
}
