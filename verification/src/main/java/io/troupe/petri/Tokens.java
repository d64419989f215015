package io.troupe.petri;

/** Sums of tokens, which throw on overflow. */
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
