package io.troupe.demo.evaluate;

import io.troupe.services.subsumption.Mode;

/**
 * One measured number.
 *
 * @param cores for which the JVM was configured
 * @param repetition from 1; measurements of one repetition were taken close together in time
 * @param subject a service, or {@value #BOTH}
 */
record Measurement(
        MeasurementKind kind, Mode mode, int cores, int repetition, String subject, Quantity quantity, double value) {
    static final String BOTH = "both";
}
