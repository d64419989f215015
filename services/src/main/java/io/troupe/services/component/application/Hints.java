package io.troupe.services.component.application;

import io.troupe.common.text.Suggestions;
import java.util.Collection;
import java.util.List;

/** Hints for messages about unknown names: the nearest known name, and the permitted names. */
final class Hints {
    private static final int FEW = 12;

    private Hints() {}

    static String of(String written, Collection<String> known) {
        List<String> some = known.stream().sorted().limit(FEW).toList();
        String expected = "expected one of " + String.join(", ", some) + (known.size() > FEW ? ", .." : "");
        return Suggestions.nearest(written, known)
                .map(name -> "did you mean \"" + name + "\"? " + expected)
                .orElse(known.isEmpty() ? "there is none" : expected);
    }
}
