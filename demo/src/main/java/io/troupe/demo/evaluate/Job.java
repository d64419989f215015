package io.troupe.demo.evaluate;

import io.troupe.demo.evaluate.Measurement.Kind;
import io.troupe.demo.evaluate.Measurement.Quantity;
import io.troupe.services.subsumption.Mode;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

/**
 * One run to measure, and its {@link Result}; sent to the measuring JVM and back as lines of text.
 *
 * @param subject name of a service, or {@value Measurement#BOTH}
 * @param loops of each service, for {@link Kind#LOOPS} and {@link Kind#ALONE}
 * @param seconds in robot time, for the other kinds
 * @param seed of the start poses
 * @param server local TCP port of a world in real time; 0 for a separate world in lock step
 */
record Job(Kind kind, Mode mode, String subject, int loops, double seconds, long seed, int server) {
    private static final int FIELDS = 7;

    boolean countsLoops() {
        return kind == Kind.LOOPS || kind == Kind.ALONE;
    }

    /** A description without the parameters that vary between repetitions. */
    String title() {
        return String.format(Locale.ROOT, "%s mode, %s%s", mode, kind, kind == Kind.ALONE ? " (" + subject + ")" : "");
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
                Kind.valueOf(fields[0]),
                Mode.valueOf(fields[1]),
                fields[2],
                Integer.parseInt(fields[3]),
                Double.parseDouble(fields[4]),
                Long.parseLong(fields[5]),
                Integer.parseInt(fields[6]));
    }

    /** The measured values of one run. */
    record Result(List<Value> values) {
        record Value(String subject, Quantity quantity, double value) {
            String line() {
                return subject + " " + quantity.name() + " " + value;
            }

            static Value parse(String line) {
                String[] fields = line.split(" ", -1);
                if (fields.length != 3) {
                    throw new IllegalArgumentException("a value of " + fields.length + " fields, expected 3: " + line);
                }
                return new Value(fields[0], Quantity.valueOf(fields[1]), Double.parseDouble(fields[2]));
            }
        }

        Result {
            values = List.copyOf(values);
        }

        List<String> lines() {
            return values.stream().map(Value::line).toList();
        }

        /** @throws IllegalArgumentException if the lines were not written by {@link #lines} */
        static Result parse(List<String> lines) {
            return new Result(lines.stream().map(Value::parse).toList());
        }

        /** Collects values. */
        static final class Builder {
            private final List<Value> values = new ArrayList<>();

            Builder add(String subject, Quantity quantity, double value) {
                values.add(new Value(subject, quantity, value));
                return this;
            }

            Result build() {
                return new Result(values);
            }
        }
    }
}
