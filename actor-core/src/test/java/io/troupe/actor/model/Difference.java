package io.troupe.actor.model;

import java.util.List;
import org.jspecify.annotations.Nullable;

/** The first difference between the events of the library and those of the model. */
final class Difference {
    private Difference() {}

    /** The first difference, or null if all events are equal. */
    static @Nullable String of(List<Act> program) {
        var expected = ModelRun.of(program).events();
        var shown = LibraryRun.of(program).events();
        if (expected.equals(shown)) {
            return null;
        }
        int same = firstDifference(expected, shown);
        var before = String.join("\n  ", expected.subList(Math.max(0, same - 12), same));
        return "after %d equal events, the last of which are%n  %s%nthe model expects%n  %s%nand the library shows%n  %s"
                .formatted(same, before, at(expected, same), at(shown, same));
    }

    private static int firstDifference(List<String> one, List<String> other) {
        int at = 0;
        while (at < one.size() && at < other.size() && one.get(at).equals(other.get(at))) {
            at++;
        }
        return at;
    }

    private static String at(List<String> events, int index) {
        return index < events.size() ? events.get(index) : "nothing more";
    }
}
