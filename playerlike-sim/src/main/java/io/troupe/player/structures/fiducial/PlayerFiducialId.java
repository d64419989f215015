package io.troupe.player.structures.fiducial;

/** Part of a message of the Player interface fiducial. */
public class PlayerFiducialId {
    private int id;

    public synchronized int getId() {
        return id;
    }

    public synchronized void setId(int value) {
        id = value;
    }
}
