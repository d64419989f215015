package io.troupe.demo.evaluate;

import io.troupe.services.subsumption.Mode;

/**
 * One measured number.
 *
 * @param cores what the JVM was told
 * @param repetition from 1; those of one number, in different modes, were measured soon after each other
 * @param subject a service, or {@value #BOTH}
 */
record Measurement(Part part, Mode mode, int cores, int repetition, String subject, Quantity quantity, double value) {
    static final String BOTH = "both";
}
