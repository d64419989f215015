package io.troupe.tools;

/**
 * How often tests repeat what they do with random inputs: a few times, or many with {@code -Dthorough}.
 *
 * <pre>{@code
 * private static final int TABLES = Thorough.times(200, 2_000);
 * }</pre>
 */
public final class Thorough {
    private static final boolean ON = !System.getProperty("thorough", "false").equals("false");

    private Thorough() {}

    /** True if tests take the time for everything. */
    public static boolean on() {
        return ON;
    }

    /** The first number, or the second one if tests are thorough. */
    public static int times(int quick, int thorough) {
        return ON ? thorough : quick;
    }
}
