package io.troupe.player.structures.sonar;

/** One range per sonar, in metres. */
public class PlayerSonarData {
    private int ranges_count;
    private float[] ranges = new float[0];

    public synchronized int getRanges_count() {
        return ranges_count;
    }

    public synchronized void setRanges_count(int value) {
        ranges_count = value;
    }

    public synchronized float[] getRanges() {
        return ranges;
    }

    public synchronized void setRanges(float[] value) {
        ranges = value;
    }
}
