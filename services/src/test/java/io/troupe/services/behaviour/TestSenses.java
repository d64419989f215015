package io.troupe.services.behaviour;

import java.util.Arrays;

/** Sensor data for tests. */
public final class TestSenses {
    private TestSenses() {}

    /** A blob one column wide in an image of 80 by 60 pixels. */
    public static Blob blob(int colour, int areaPx2, int leftPx) {
        return new Blob(colour, areaPx2, leftPx, leftPx, 25, 35, 80, 60, 1);
    }

    /** A ring whose sonars read 5 m, except those in the arguments: alternately a sonar and its range. */
    public static SonarRing ring(double... sonarAndRange) {
        var ranges = new float[16];
        Arrays.fill(ranges, 5f);
        for (int i = 0; i < sonarAndRange.length; i += 2) {
            ranges[(int) sonarAndRange[i]] = (float) sonarAndRange[i + 1];
        }
        return SonarRing.of(ranges);
    }
}
