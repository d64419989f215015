package io.troupe.demo.evaluate;

import io.troupe.services.subsumption.Mode;
import java.util.Locale;

/**
 * One run to measure, as a line of text for the JVM that does it.
 *
 * @param subject a service by its name, or both
 * @param loops of each service, for {@link Part#LOOPS} and {@link Part#ALONE}
 * @param seconds on the robots' clock, for the others
 * @param seed of the start poses
 * @param server the TCP port of the robots on this machine, which move in real time; 0 for a world of the job's own, in
 *     lock step
 */
record Job(Part part, Mode mode, String subject, int loops, double seconds, long seed, int server) {
    private static final int FIELDS = 7;

    boolean countsLoops() {
        return part == Part.LOOPS || part == Part.ALONE;
    }

    /** The same without what repetitions change. */
    String title() {
        return String.format(Locale.ROOT, "%s mode, %s%s", mode, part, part == Part.ALONE ? " (" + subject + ")" : "");
    }

    String line() {
        return String.format(
                Locale.ROOT, "%s %s %s %d %s %d %d", part.name(), mode.name(), subject, loops, seconds, seed, server);
    }

    /** @throws IllegalArgumentException if the line is none that {@link #line} writes */
    static Job parse(String line) {
        String[] fields = line.split(" ", -1);
        if (fields.length != FIELDS) {
            throw new IllegalArgumentException(
                    "a job of " + fields.length + " fields, expected " + FIELDS + ": " + line);
        }
        return new Job(
                Part.valueOf(fields[0]),
                Mode.valueOf(fields[1]),
                fields[2],
                Integer.parseInt(fields[3]),
                Double.parseDouble(fields[4]),
                Long.parseLong(fields[5]),
                Integer.parseInt(fields[6]));
    }
}
