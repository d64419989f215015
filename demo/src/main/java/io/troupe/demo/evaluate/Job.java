package io.troupe.demo.evaluate;

import io.troupe.services.subsumption.Mode;
import java.util.Locale;

/**
 * One run to measure; sent to the measuring JVM as a line of text.
 *
 * @param subject name of a service, or {@value Measurement#BOTH}
 * @param loops of each service, for {@link MeasurementKind#LOOPS} and {@link MeasurementKind#ALONE}
 * @param seconds in robot time, for the other kinds
 * @param seed of the start poses
 * @param server local TCP port of a world in real time; 0 for a separate world in lock step
 */
record Job(MeasurementKind kind, Mode mode, String subject, int loops, double seconds, long seed, int server) {
    private static final int FIELDS = 7;

    boolean countsLoops() {
        return kind == MeasurementKind.LOOPS || kind == MeasurementKind.ALONE;
    }

    /** A description without the parameters that vary between repetitions. */
    String title() {
        return String.format(
                Locale.ROOT, "%s mode, %s%s", mode, kind, kind == MeasurementKind.ALONE ? " (" + subject + ")" : "");
    }

    String line() {
        return String.format(
                Locale.ROOT, "%s %s %s %d %s %d %d", kind.name(), mode.name(), subject, loops, seconds, seed, server);
    }

    /** @throws IllegalArgumentException if the line was not written by {@link #line} */
    static Job parse(String line) {
        String[] fields = line.split(" ", -1);
        if (fields.length != FIELDS) {
            throw new IllegalArgumentException(
                    "a job of " + fields.length + " fields, expected " + FIELDS + ": " + line);
        }
        return new Job(
                MeasurementKind.valueOf(fields[0]),
                Mode.valueOf(fields[1]),
                fields[2],
                Integer.parseInt(fields[3]),
                Double.parseDouble(fields[4]),
                Long.parseLong(fields[5]),
                Integer.parseInt(fields[6]));
    }
}
