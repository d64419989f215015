package io.troupe.petri.structure;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.util.Arrays;
import java.util.Collection;
import java.util.Objects;
import java.util.Set;
import java.util.regex.Pattern;
import java.util.stream.Collectors;

/** Lists of sets of places that other tools found, from JSON files of the form {"list": [["P1", "P4"], ...], ...}. */
final class SetLists {
    private SetLists() {}

    static Set<Set<String>> read(String file, String list) {
        var text = text(file);
        var body = Pattern.compile("\"" + list + "\"\\s*:\\s*\\[((?:\\s*\\[[^\\[\\]]*\\]\\s*,?)*)\\s*\\]")
                .matcher(text);
        if (!body.find()) {
            throw new IllegalArgumentException(file + " has no list of lists called " + list);
        }
        return Pattern.compile("\\[([^\\[\\]]*)\\]")
                .matcher(body.group(1))
                .results()
                .map(set -> Arrays.stream(set.group(1).split(","))
                        .map(name -> name.strip().replace("\"", ""))
                        .collect(Collectors.toUnmodifiableSet()))
                .collect(Collectors.toUnmodifiableSet());
    }

    static Set<Set<String>> names(Collection<PlaceSet> sets) {
        return sets.stream()
                .map(set -> set.places().stream().map(place -> place.name()).collect(Collectors.toUnmodifiableSet()))
                .collect(Collectors.toUnmodifiableSet());
    }

    private static String text(String file) {
        try (var in = Objects.requireNonNull(SetLists.class.getResourceAsStream(file), file)) {
            return new String(in.readAllBytes(), StandardCharsets.UTF_8);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot read " + file, e);
        }
    }
}
