package io.troupe.player.structures.fiducial;

/** Data of the Player interface fiducial. */
public class PlayerFiducialData {
    private int fiducials_count;
    private PlayerFiducialItem[] fiducials = new PlayerFiducialItem[0];

    public synchronized int getFiducials_count() {
        return fiducials_count;
    }

    public synchronized void setFiducials_count(int value) {
        fiducials_count = value;
    }

    public synchronized PlayerFiducialItem[] getFiducials() {
        return fiducials;
    }

    public synchronized void setFiducials(PlayerFiducialItem[] value) {
        fiducials = value;
    }
}
