package io.troupe.demo.evaluate;

import java.util.Locale;

/** What is run for a measurement. */
enum Part {
    /** Both services until each has done its loops, in a state that nothing ends. */
    LOOPS,
    /** One service by itself until it has done its loops. */
    ALONE,
    /** The paper's three states for a while. */
    SWITCHES,
    /** The same, and each service connects anew when it takes charge. */
    RECONNECTS;

    @Override
    public String toString() {
        return name().toLowerCase(Locale.ROOT);
    }
}
