package io.troupe.services.behaviour;

/**
 * The readings of a Pioneer 2DX sonar ring, grouped as the control laws use them.
 *
 * <p><b>Units and shapes.</b> Metres, clamped to [{@value #MIN_M}, {@value #MAX_M}]. Sonars 0 to 7 look forward from
 * left to right, at +90, +50, +30, +10, -10, -30, -50 and -90 degrees; the ones behind are not used.
 */
public final class SonarRing {
    public static final double MIN_M = 0.2;
    public static final double MAX_M = 5.0;
    private static final int USED = 8;

    private final double[] rangesM = new double[USED];

    private SonarRing(float[] readingsM) {
        for (int sonar = 0; sonar < USED; sonar++) {
            rangesM[sonar] = StrictMath.max(MIN_M, StrictMath.min(MAX_M, readingsM[sonar]));
        }
    }

    /**
     * Creates a ring from the readings of its sonars.
     *
     * @throws IllegalArgumentException if there are fewer than 8 readings, or one of the first 8 is not a number
     */
    public static SonarRing of(float[] readingsM) {
        if (readingsM.length < USED) {
            throw new IllegalArgumentException(
                    "a sonar ring has " + readingsM.length + " readings, expected " + USED + " or more");
        }
        for (int sonar = 0; sonar < USED; sonar++) {
            if (Float.isNaN(readingsM[sonar])) {
                throw new IllegalArgumentException("sonar " + sonar + " reads NaN, expected metres");
            }
        }
        return new SonarRing(readingsM);
    }

    /** The range of a sonar, 0 to 7. */
    public double rangeM(int sonar) {
        return rangesM[sonar];
    }

    /** The smallest range on the left: sonars 0, 1 and 2. */
    public double leftM() {
        return StrictMath.min(rangesM[0], StrictMath.min(rangesM[1], rangesM[2]));
    }

    /** The smallest range ahead: sonars 3 and 4. */
    public double frontM() {
        return StrictMath.min(rangesM[3], rangesM[4]);
    }
}
