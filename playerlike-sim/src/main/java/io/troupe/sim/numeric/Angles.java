package io.troupe.sim.numeric;

/** Angles in radians. */
public final class Angles {
    private static final double FULL_TURN_RAD = 2 * StrictMath.PI;

    private Angles() {}

    /**
     * Wraps an angle to -pi to pi, bit for bit as {@link StrictMath#IEEEremainder} does.
     *
     * <p><b>Source.</b> Below half a turn the remainder is the angle. Up to one and a half turns it is a difference
     * that a double represents exactly, so that a subtraction does not round it; only a zero may have another sign.
     */
    public static double wrap(double angleRad) {
        double sizeRad = Math.abs(angleRad);
        if (sizeRad < StrictMath.PI) {
            return angleRad;
        }
        double restRad = angleRad - Math.copySign(FULL_TURN_RAD, angleRad);
        return sizeRad > StrictMath.PI && sizeRad < 3 * 3.14 && restRad != 0
                ? restRad
                : StrictMath.IEEEremainder(angleRad, FULL_TURN_RAD);
    }
}
