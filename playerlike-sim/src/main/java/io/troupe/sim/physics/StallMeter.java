package io.troupe.sim.physics;

/** Compares, over the last 0.2 s, how far a robot was told to go with how far it went. */
final class StallMeter {
    private static final int WINDOW_MICROS = 200_000;
    /** Less than this in a window (metres or radians) is rounding, not travel. */
    private static final double NEGLIGIBLE = 1e-4;

    private final double[] toldM;
    private final double[] wentM;
    private final double[] toldRad;
    private final double[] wentRad;
    private int next;

    StallMeter(int stepMicros) {
        int length = Math.max(1, WINDOW_MICROS / stepMicros);
        toldM = new double[length];
        wentM = new double[length];
        toldRad = new double[length];
        wentRad = new double[length];
    }

    /** One step: the travel told, never negative, and the travel achieved in that direction. */
    void record(double stepToldM, double stepWentM, double stepToldRad, double stepWentRad) {
        toldM[next] = stepToldM;
        wentM[next] = stepWentM;
        toldRad[next] = stepToldRad;
        wentRad[next] = stepWentRad;
        next = (next + 1) % toldM.length;
    }

    /** Whether less than half of what was told was achieved, in driving or in turning. */
    boolean heldBack() {
        return lessThanHalf(wentM, toldM) || lessThanHalf(wentRad, toldRad);
    }

    private static boolean lessThanHalf(double[] went, double[] told) {
        double toldSum = sum(told);
        return toldSum > NEGLIGIBLE && sum(went) < toldSum / 2;
    }

    private static double sum(double[] values) {
        double sum = 0;
        for (double value : values) {
            sum += value;
        }
        return sum;
    }
}
