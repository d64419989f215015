package io.troupe.player.structures.blobfinder;

/** The colours that a blobfinder tracks on one channel; components from 0 to 255. */
public class PlayerBlobfinderColorConfig {
    private int channel;
    private int rmin;
    private int rmax;
    private int gmin;
    private int gmax;
    private int bmin;
    private int bmax;

    public synchronized int getChannel() {
        return channel;
    }

    public synchronized void setChannel(int value) {
        channel = value;
    }

    public synchronized int getRmin() {
        return rmin;
    }

    public synchronized void setRmin(int value) {
        rmin = value;
    }

    public synchronized int getRmax() {
        return rmax;
    }

    public synchronized void setRmax(int value) {
        rmax = value;
    }

    public synchronized int getGmin() {
        return gmin;
    }

    public synchronized void setGmin(int value) {
        gmin = value;
    }

    public synchronized int getGmax() {
        return gmax;
    }

    public synchronized void setGmax(int value) {
        gmax = value;
    }

    public synchronized int getBmin() {
        return bmin;
    }

    public synchronized void setBmin(int value) {
        bmin = value;
    }

    public synchronized int getBmax() {
        return bmax;
    }

    public synchronized void setBmax(int value) {
        bmax = value;
    }
}
