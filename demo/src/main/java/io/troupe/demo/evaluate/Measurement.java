package io.troupe.demo.evaluate;

import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.Service;
import java.util.Locale;

/**
 * One measured number.
 *
 * @param cores for which the JVM was configured
 * @param repetition from 1; measurements of one repetition were taken close together in time
 * @param subject {@link #FOLLOWER}, {@link #WANDERER} or {@link #BOTH}
 */
record Measurement(Kind kind, Mode mode, int cores, int repetition, String subject, Quantity quantity, double value) {
    /** Subject of what is measured of both services together, or of the whole run. */
    static final String BOTH = "both";

    static final String FOLLOWER = Service.WALL_FOLLOWER.name();
    static final String WANDERER = Service.SPACE_WANDERER.name();

    /** What a measured run executes, and until when; the column {@code part} of the CSV file. */
    enum Kind {
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
         * Machine time to compute one loop of each service and deliver their colours to the main code. The mean without
         * the longest hundredth.
         */
        TURN("us"),
        /**
         * Processor time of the thread that runs the services, for one loop of each, including all messages and a
         * wake-up per reading.
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
         * Machine time from the cycle that sees the colour that ends a state to the last robot's first cycle in the
         * next state. The median of the switches that take no robot time.
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
}
