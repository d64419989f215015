package io.troupe.demo.evaluate;

import java.util.Locale;

/** What a measured run executes, and until when; the column {@code part} of the CSV file. */
enum MeasurementKind {
    /** Both services, until each has done its loops, in a state that nothing ends. */
    LOOPS,
    /** One service alone, until it has done its loops. */
    ALONE,
    /** The paper's three states, for a fixed time. */
    SWITCHES,
    /** As {@link #SWITCHES}, with a new connection whenever a service starts. */
    RECONNECTS;

    @Override
    public String toString() {
        return name().toLowerCase(Locale.ROOT);
    }
}
