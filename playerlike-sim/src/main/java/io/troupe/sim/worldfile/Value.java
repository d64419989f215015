package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import java.util.List;

/** The value of a property. */
sealed interface Value {
    SourcePosition where();

    /** The value as shown in messages: its kind and its text. */
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

    /** Values in square brackets: numbers and texts, no tuples. */
    record Tuple(List<Value> items, SourcePosition where) implements Value {
        @Override
        public String shown() {
            return items.size() == 1 ? "a tuple of 1 value" : "a tuple of " + items.size() + " values";
        }
    }
}
