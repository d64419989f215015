package io.troupe.player.structures.fiducial;

/** A part of the messages of a finder of marks; no device here uses it. */
public class PlayerFiducialId {
    private int id;

    public synchronized int getId() {
        return id;
    }

    public synchronized void setId(int value) {
        id = value;
    }
}
