package io.troupe.services.behaviour;

/** Argument checks of the behaviours. */
final class Preconditions {
    private Preconditions() {}

    static void requirePositive(String what, double value, String unit) {
        if (!(value > 0) || Double.isInfinite(value)) {
            throw new IllegalArgumentException(what + " is " + value + " " + unit + ", expected more than 0");
        }
    }
}
