package io.troupe.sim.numeric;

/**
 * Cosine and sine of an angle, bit for bit those of {@link StrictMath}.
 *
 * <p><b>Role.</b> For angles beyond a quarter of pi, {@code StrictMath} allocates an array and reduces the angle twice,
 * once for the cosine and once for the sine. This class reduces it once for both, without allocation. Angles beyond 5
 * rad are left to {@code StrictMath}.
 *
 * <p><b>Threads.</b> One thread at a time.
 *
 * <p><b>Source.</b> The reduction and the polynomials that {@code StrictMath} prescribes: those of fdlibm 5.3.
 */
public final class Direction {
    private static final double MOST_RAD = 5;
    private static final int QUARTER_PI_HIGH = 0x3fe921fb; // upper words of doubles
    private static final int HALF_PI_HIGH = 0x3ff921fb;
    private static final int PI_HIGH = 0x400921fb;
    private static final int THREE_HALVES_PI_HIGH = 0x4012d97c;
    private static final int TINY_HIGH = 0x3e400000; // 2^-27
    private static final int LARGE_HIGH = 0x3fe90000; // 0.78125
    private static final int THIRD_HIGH = 0x3fd33333; // 0.3

    private static final double TWO_OVER_PI = 6.36619772367581382433e-01;
    /** The first 33 bits of pi / 2, and the remainder. */
    private static final double HALF_PI = 1.57079632673412561417e+00;

    private static final double HALF_PI_REST = 6.07710050650619224932e-11;
    /** The next 33 bits and the remainder, twice. */
    private static final double HALF_PI_2 = 6.07710050630396597660e-11;

    private static final double HALF_PI_REST_2 = 2.02226624879595063154e-21;
    private static final double HALF_PI_3 = 2.02226624871116645580e-21;
    private static final double HALF_PI_REST_3 = 8.47842766036889956997e-32;

    private static final double S1 = -1.66666666666666324348e-01;
    private static final double S2 = 8.33333333332248946124e-03;
    private static final double S3 = -1.98412698298579493134e-04;
    private static final double S4 = 2.75573137070700676789e-06;
    private static final double S5 = -2.50507602534068634195e-08;
    private static final double S6 = 1.58969099521155010221e-10;
    private static final double C1 = 4.16666666666666019037e-02;
    private static final double C2 = -1.38888888888741095749e-03;
    private static final double C3 = 2.48015872894767294178e-05;
    private static final double C4 = -2.75573143513906633035e-07;
    private static final double C5 = 2.08757232129817482790e-09;
    private static final double C6 = -1.13596475577881948265e-11;

    private double angleRad;
    private double cos = 1;
    private double sin;

    public double cos() {
        return cos;
    }

    public double sin() {
        return sin;
    }

    /** Sets the angle; an unchanged angle costs nothing. */
    public void set(double newAngleRad) {
        if (Double.doubleToRawLongBits(newAngleRad) == Double.doubleToRawLongBits(angleRad)) {
            return;
        }
        angleRad = newAngleRad;
        int high = high(newAngleRad) & 0x7fffffff;
        if (high <= QUARTER_PI_HIGH) {
            cos = cosine(newAngleRad, 0);
            sin = sine(newAngleRad, 0, false);
        } else if (Math.abs(newAngleRad) < MOST_RAD) {
            reduce(newAngleRad, high);
        } else {
            cos = StrictMath.cos(newAngleRad);
            sin = StrictMath.sin(newAngleRad);
        }
    }

    private void reduce(double angle, int high) {
        double size = Math.abs(angle);
        int quarters = (int) (size * TWO_OVER_PI + 0.5);
        double rough = size - quarters * HALF_PI;
        double correction = quarters * HALF_PI_REST;
        double rest = rough - correction;
        if (high == HALF_PI_HIGH) { // here, and near other multiples of pi / 2, the remainder needs more digits
            rough -= HALF_PI_2;
            correction = HALF_PI_REST_2;
            rest = rough - correction;
        } else if (high == PI_HIGH || high == THREE_HALVES_PI_HIGH) {
            int exponent = high >> 20;
            if (exponent - exponent(rest) > 16) {
                double before = rough;
                double step = quarters * HALF_PI_2;
                rough = before - step;
                correction = quarters * HALF_PI_REST_2 - ((before - rough) - step);
                rest = rough - correction;
            }
            if (exponent - exponent(rest) > 49) {
                double before = rough;
                double step = quarters * HALF_PI_3;
                rough = before - step;
                correction = quarters * HALF_PI_REST_3 - ((before - rough) - step);
                rest = rough - correction;
            }
        }
        double tail = (rough - rest) - correction;
        turn(angle < 0, quarters, rest, tail);
    }

    private static int exponent(double value) {
        return high(value) >> 20 & 0x7ff;
    }

    private void turn(boolean negative, int quartersOfSize, double restOfSize, double tailOfSize) {
        int quarters = quartersOfSize;
        double rest = restOfSize;
        double tail = tailOfSize;
        if (negative) {
            rest = -rest;
            tail = -tail;
            quarters = -quarters;
        }
        double c = cosine(rest, tail);
        double s = sine(rest, tail, true);
        switch (quarters & 3) {
            case 0 -> {
                cos = c;
                sin = s;
            }
            case 1 -> {
                cos = -s;
                sin = c;
            }
            case 2 -> {
                cos = -c;
                sin = -s;
            }
            default -> {
                cos = s;
                sin = -c;
            }
        }
    }

    private static double sine(double x, double tail, boolean reduced) {
        if ((high(x) & 0x7fffffff) < TINY_HIGH) {
            return x;
        }
        double z = x * x;
        double v = z * x;
        double r = S2 + z * (S3 + z * (S4 + z * (S5 + z * S6)));
        return reduced ? x - ((z * (0.5 * tail - v * r) - tail) - v * S1) : x + v * (S1 + z * r);
    }

    private static double cosine(double x, double tail) {
        int high = high(x) & 0x7fffffff;
        if (high < TINY_HIGH) {
            return 1;
        }
        double z = x * x;
        double r = z * (C1 + z * (C2 + z * (C3 + z * (C4 + z * (C5 + z * C6)))));
        if (high < THIRD_HIGH) {
            return 1 - (0.5 * z - (z * r - x * tail));
        }
        double quarter = high > LARGE_HIGH ? 0.28125 : Double.longBitsToDouble((long) (high - 0x00200000) << 32);
        double half = 0.5 * z - quarter;
        return (1 - quarter) - (half - (z * r - x * tail));
    }

    private static int high(double value) {
        return (int) (Double.doubleToRawLongBits(value) >> 32);
    }
}
