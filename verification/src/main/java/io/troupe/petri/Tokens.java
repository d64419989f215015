package io.troupe.petri;

/** Sums of tokens, exact or refused. */
final class Tokens {
    private Tokens() {}

    static int sum(int held, int more, Place place) {
        var total = (long) held + more;
        if (total > Integer.MAX_VALUE) {
            throw new ArithmeticException(
                    "place " + place + " would hold " + total + " tokens, more than " + Integer.MAX_VALUE);
        }
        return (int) total;
    }
}
