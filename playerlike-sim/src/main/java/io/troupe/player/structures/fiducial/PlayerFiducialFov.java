package io.troupe.player.structures.fiducial;

/** Part of a message of the Player interface fiducial. */
public class PlayerFiducialFov {
    private float min_range;
    private float max_range;
    private float view_angle;

    public synchronized float getMin_range() {
        return min_range;
    }

    public synchronized void setMin_range(float value) {
        min_range = value;
    }

    public synchronized float getMax_range() {
        return max_range;
    }

    public synchronized void setMax_range(float value) {
        max_range = value;
    }

    public synchronized float getView_angle() {
        return view_angle;
    }

    public synchronized void setView_angle(float value) {
        view_angle = value;
    }
}
