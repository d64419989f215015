package io.troupe.demo.evaluate;

import java.util.Locale;

/** A measured quantity and its unit. */
enum Quantity {
    /** Robot time from the first reading that the services wait for to the end of the last loop. */
    TIME("ms"),
    /** Robot time between the starts of two cycles of one service: the median. */
    INTERVAL("ms"),
    /** The same: the 99th percentile. */
    INTERVAL_P99("ms"),
    /**
     * Machine time to compute one loop: look for colours, send them, read sensors, control law, command. The mean
     * without the longest hundredth.
     */
    CYCLE("us"),
    /** The same: the 99th percentile. */
    CYCLE_P99("us"),
    /**
     * Machine time to compute one loop of each service and deliver their colours to the main code. The mean without the
     * longest hundredth.
     */
    TURN("us"),
    /**
     * Processor time of the thread that runs the services, for one loop of each, including all messages and a wake-up
     * per reading.
     */
    PROCESSOR("us"),
    STATE_CHANGES("1"),
    /** Colour messages sent by services. */
    SENT("1"),
    /** Colour messages received by the main code. */
    RECEIVED("1"),
    /** Machine time from sending a colour to its receipt by the main code: the median. */
    DELAY("us"),
    /** The same: the 99th percentile. */
    DELAY_P99("us"),
    /**
     * Machine time from the cycle that sees the colour that ends a state to the last robot's first cycle in the next
     * state. The median of the switches that take no robot time.
     */
    SWITCH("us"),
    /** The same in robot time. */
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
