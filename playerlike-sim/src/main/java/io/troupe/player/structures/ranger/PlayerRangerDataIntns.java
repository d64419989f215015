package io.troupe.player.structures.ranger;

/** The intensity of the echo of each range of a ranger. */
public class PlayerRangerDataIntns {
    private int intns_count;
    private double[] intens = new double[0];

    public synchronized int getIntns_count() {
        return intns_count;
    }

    public synchronized void setIntns_count(int value) {
        intns_count = value;
    }

    public synchronized double[] getIntens() {
        return intens;
    }

    public synchronized void setIntens(double[] value) {
        intens = value;
    }
}
