package io.troupe.player.structures.ptz;

/** Data of the Player interface ptz. This client does not use it. */
public class PlayerPtzData {
    private float pan;
    private float tilt;
    private float zoom;
    private float panspeed;
    private float tiltspeed;

    public synchronized float getPan() {
        return pan;
    }

    public synchronized void setPan(float value) {
        pan = value;
    }

    public synchronized float getTilt() {
        return tilt;
    }

    public synchronized void setTilt(float value) {
        tilt = value;
    }

    public synchronized float getZoom() {
        return zoom;
    }

    public synchronized void setZoom(float value) {
        zoom = value;
    }

    public synchronized float getPanspeed() {
        return panspeed;
    }

    public synchronized void setPanspeed(float value) {
        panspeed = value;
    }

    public synchronized float getTiltspeed() {
        return tiltspeed;
    }

    public synchronized void setTiltspeed(float value) {
        tiltspeed = value;
    }
}
