package io.troupe.demo.evaluate;

import java.util.ArrayList;
import java.util.List;

/** The measured values of one run; lines of text between two JVMs. */
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
