package io.troupe.player.structures.ranger;

/** The ranges of all elements of a ranger, in metres. */
public class PlayerRangerData {
    private int ranges_count;
    private double[] ranges = new double[0];

    public synchronized int getRanges_count() {
        return ranges_count;
    }

    public synchronized void setRanges_count(int value) {
        ranges_count = value;
    }

    public synchronized double[] getRanges() {
        return ranges;
    }

    public synchronized void setRanges(double[] value) {
        ranges = value;
    }
}
