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

    private static final int COMMANDED_X = 0;
    private static final int COMMANDED_Y = 1;
    private static final int ACTUAL_X = 2;
    private static final int ACTUAL_Y = 3;
    private static final int COMMANDED_TURN_RADPS = 4;
    private static final int ACTUAL_RAD = 5;
    private static final int FIELDS = 6;

    private final double stepS;
    private final double[] steps; // a ring buffer of records
    private int next;

    StallMeter(int stepMicros) {
        stepS = stepMicros / 1e6;
        steps = new double[FIELDS * Math.max(1, WINDOW_MICROS / stepMicros)];
    }

    /**
     * Records the commanded and the actual motion of one step, in metres; turns left positive, {@code actualRad}
     * unwrapped.
     */
    void record(
            double commandedX,
            double commandedY,
            double actualX,
            double actualY,
            double commandedTurnRadps,
            double actualRad) {
        steps[next + COMMANDED_X] = commandedX;
        steps[next + COMMANDED_Y] = commandedY;
        steps[next + ACTUAL_X] = actualX;
        steps[next + ACTUAL_Y] = actualY;
        steps[next + COMMANDED_TURN_RADPS] = commandedTurnRadps;
        steps[next + ACTUAL_RAD] = actualRad;
        next += FIELDS;
        if (next == steps.length) {
            next = 0;
        }
    }

    /** True if less than half of the commanded motion was achieved, in driving or in turning. */
    boolean heldBack() {
        double commandedSumM = 0;
        double actualSumM = 0;
        double commandedSumRad = 0;
        double actualSumRad = 0;
        for (int i = 0; i < steps.length; i += FIELDS) {
            double commandedX = steps[i + COMMANDED_X];
            double commandedY = steps[i + COMMANDED_Y];
            double commandedM = StrictMath.hypot(commandedX, commandedY);
            commandedSumM += commandedM;
            actualSumM += commandedM == 0
                    ? 0
                    : (steps[i + ACTUAL_X] * commandedX + steps[i + ACTUAL_Y] * commandedY) / commandedM;
            double turnRadps = steps[i + COMMANDED_TURN_RADPS];
            commandedSumRad += Math.abs(turnRadps) * stepS;
            actualSumRad += RobotBody.wrap(steps[i + ACTUAL_RAD]) * Math.signum(turnRadps);
        }
        return lessThanHalf(actualSumM, commandedSumM) || lessThanHalf(actualSumRad, commandedSumRad);
    }

    private static boolean lessThanHalf(double actual, double commanded) {
        return commanded > NEGLIGIBLE && actual < commanded / 2;
    }
}
