package io.troupe.demo.evaluate;

import java.util.Locale;

/** What is measured. */
enum Quantity {
    /** On the robots' clock, from the first reading that the services wait for to the end of the last loop. */
    TIME("ms"),
    /** Between the beginnings of two cycles of one service, on the robots' clock: the middle of all. */
    INTERVAL("ms"),
    /** The same: what 99 of 100 do not exceed. */
    INTERVAL_P99("ms"),
    /**
     * One loop's computing, by the machine's clock: look for colours, send them, read, control law, command. The mean
     * without the longest hundredth.
     */
    CYCLE("us"),
    /** The same: what 99 of 100 do not exceed. */
    CYCLE_P99("us"),
    /**
     * The computing of one loop of each service and the way of their colours to the main code, by the machine's clock.
     * The mean without the longest hundredth.
     */
    TURN("us"),
    /**
     * Processor time of the thread that runs the services, for one loop of each, with all messages, and with waking up
     * for each reading.
     */
    PROCESSOR("us"),
    STATE_CHANGES("1"),
    /** Colours that left a service for the main code. */
    SENT("1"),
    /** Colours that the main code got. */
    RECEIVED("1"),
    /** From sending a colour to the main code having it, by the machine's clock: the middle of all. */
    DELAY("us"),
    /** The same: what 99 of 100 do not exceed. */
    DELAY_P99("us"),
    /**
     * From the cycle that sees the colour that ends a state to every robot's first cycle in the next, by the machine's
     * clock: the middle of those that take no time on the robots' clock.
     */
    SWITCH("us"),
    /** The same on the robots' clock. */
    SWITCH_TIME("ms");

    private final String unit;

    Quantity(String unit) {
        this.unit = unit;
    }

    String unit() {
        return unit;
    }

    @Override
    public String toString() {
        return name().toLowerCase(Locale.ROOT);
    }
}
