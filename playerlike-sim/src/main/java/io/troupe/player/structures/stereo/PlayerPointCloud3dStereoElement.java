package io.troupe.player.structures.stereo;

/** Part of a message of the Player interface stereo. This client does not use it. */
public class PlayerPointCloud3dStereoElement {
    private float px;
    private float py;
    private float pz;
    private byte red;
    private byte green;
    private byte blue;

    public synchronized float getPx() {
        return px;
    }

    public synchronized void setPx(float value) {
        px = value;
    }

    public synchronized float getPy() {
        return py;
    }

    public synchronized void setPy(float value) {
        py = value;
    }

    public synchronized float getPz() {
        return pz;
    }

    public synchronized void setPz(float value) {
        pz = value;
    }

    public synchronized byte getRed() {
        return red;
    }

    public synchronized void setRed(byte value) {
        red = value;
    }

    public synchronized byte getGreen() {
        return green;
    }

    public synchronized void setGreen(byte value) {
        green = value;
    }

    public synchronized byte getBlue() {
        return blue;
    }

    public synchronized void setBlue(byte value) {
        blue = value;
    }
}
