package io.troupe.sim.worldfile;

import io.troupe.common.text.NamedColours;
import io.troupe.common.text.SourcePosition;
import io.troupe.common.text.Suggestions;
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

        /** The colour with this name, {@code 0x00RRGGBB}. */
        int colour() {
            return NamedColours.namedInX11(text).orElseThrow(() -> {
                String meant = Suggestions.clause(text, NamedColours.byName().keySet());
                return new WorldFileException(
                        where,
                        "unknown colour \"" + text + '"'
                                + (meant.isEmpty() ? "; expected a colour name of X11, such as \"red\"" : meant));
            });
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
