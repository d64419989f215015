package io.troupe.sim.scenario;

import java.util.List;

/** What stands after a property's name. */
sealed interface Value {
    SourcePosition where();

    /** For messages: what it is and how it was written. */
    String shown();

    /** A finite number. */
    record Num(double value, String written, SourcePosition where) implements Value {
        @Override
        public String shown() {
            return "the number " + written;
        }
    }

    record Text(String text, SourcePosition where) implements Value {
        @Override
        public String shown() {
            return "the text \"" + text + '"';
        }
    }

    /** Values in square brackets; they are numbers and texts, never tuples. */
    record Tuple(List<Value> items, SourcePosition where) implements Value {
        @Override
        public String shown() {
            return items.size() == 1 ? "a tuple of 1 value" : "a tuple of " + items.size() + " values";
        }
    }
}
