package io.troupe.sim.physics;

/**
 * Compares the commanded with the actual motion of a robot over the last 0.2 s.
 *
 * <p><b>Cost.</b> Recording, at every step, only stores numbers; the arithmetic is done when the result is read.
 */
final class StallMeter {
    private static final int WINDOW_MICROS = 200_000;
    /** Smaller sums in a window (metres or radians) are rounding, not travel. */
    private static final double NEGLIGIBLE = 1e-4;

    private static final int TOLD_X = 0;
    private static final int TOLD_Y = 1;
    private static final int WENT_X = 2;
    private static final int WENT_Y = 3;
    private static final int TOLD_TURN_RADPS = 4;
    private static final int WENT_RAD = 5;
    private static final int FIELDS = 6;

    private final double stepS;
    private final double[] steps; // a ring buffer of records
    private int next;

    StallMeter(int stepMicros) {
        stepS = stepMicros / 1e6;
        steps = new double[FIELDS * Math.max(1, WINDOW_MICROS / stepMicros)];
    }

    /**
     * Records the commanded and the actual motion of one step, in metres; turns left positive, {@code wentRad}
     * unwrapped.
     */
    void record(double toldX, double toldY, double wentX, double wentY, double toldTurnRadps, double wentRad) {
        steps[next + TOLD_X] = toldX;
        steps[next + TOLD_Y] = toldY;
        steps[next + WENT_X] = wentX;
        steps[next + WENT_Y] = wentY;
        steps[next + TOLD_TURN_RADPS] = toldTurnRadps;
        steps[next + WENT_RAD] = wentRad;
        next += FIELDS;
        if (next == steps.length) {
            next = 0;
        }
    }

    /** True if less than half of the commanded motion was achieved, in driving or in turning. */
    boolean heldBack() {
        double toldSumM = 0;
        double wentSumM = 0;
        double toldSumRad = 0;
        double wentSumRad = 0;
        for (int i = 0; i < steps.length; i += FIELDS) {
            double toldX = steps[i + TOLD_X];
            double toldY = steps[i + TOLD_Y];
            double toldM = StrictMath.hypot(toldX, toldY);
            toldSumM += toldM;
            wentSumM += toldM == 0 ? 0 : (steps[i + WENT_X] * toldX + steps[i + WENT_Y] * toldY) / toldM;
            double turnRadps = steps[i + TOLD_TURN_RADPS];
            toldSumRad += Math.abs(turnRadps) * stepS;
            wentSumRad += RobotBody.wrap(steps[i + WENT_RAD]) * Math.signum(turnRadps);
        }
        return lessThanHalf(wentSumM, toldSumM) || lessThanHalf(wentSumRad, toldSumRad);
    }

    private static boolean lessThanHalf(double went, double told) {
        return told > NEGLIGIBLE && went < told / 2;
    }
}
