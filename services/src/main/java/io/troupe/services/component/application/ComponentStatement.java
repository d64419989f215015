package io.troupe.services.component.application;

import io.troupe.services.component.Component;
import io.troupe.services.component.application.Words.Word;
import io.troupe.services.component.kinds.ArgumentException;
import io.troupe.services.component.kinds.Arguments;
import io.troupe.services.component.kinds.Kind;
import io.troupe.services.component.kinds.Kinds;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;

/**
 * The statement {@code component NAME is KIND [PARAMETER=VALUE ..]}.
 *
 * @param kind the word that names the kind
 */
record ComponentStatement(String name, Word kind, Component<?, ?> component) {
    private static final String SERVICE = "service";
    private static final String CAPABILITIES = "capabilities";

    /** Parses the rest of the line after the word {@code component}. */
    static ComponentStatement read(Words words, Kinds kinds, Path directory) {
        String name = words.name("the component's name");
        words.expect("is");
        Word kindWord = words.next("a kind of component");
        Kind kind = kinds.find(kindWord.text())
                .orElseThrow(() -> words.problem(
                        kindWord,
                        "there is no kind of component \"" + kindWord.text() + "\"; "
                                + Hints.of(
                                        kindWord.text(),
                                        kinds.all().stream().map(Kind::name).toList())));
        Map<String, Word> arguments = arguments(kind, words);
        Map<String, String> given = new LinkedHashMap<>();
        arguments.forEach((key, word) -> given.put(key, word.text()));
        List<String> service = names(SERVICE, arguments, words);
        List<String> capabilities = names(CAPABILITIES, arguments, words);
        given.keySet().removeAll(List.of(SERVICE, CAPABILITIES));
        try {
            var made = kind.maker().make(name, new Arguments(kind, given, directory));
            var offered = made.offering(
                    service.isEmpty() ? made.service() : service.getFirst(),
                    capabilities.isEmpty() ? made.capabilities() : capabilities);
            return new ComponentStatement(name, kindWord, offered);
        } catch (ArgumentException wrong) {
            throw words.problem(arguments.getOrDefault(wrong.parameter(), kindWord), wrong.getMessage());
        }
    }

    /** The comma-separated names given for a key; empty if the key is missing. */
    private static List<String> names(String key, Map<String, Word> arguments, Words words) {
        Word given = arguments.get(key);
        if (given == null) {
            return List.of();
        }
        List<String> names = key.equals(SERVICE)
                ? List.of(given.text())
                : Arrays.stream(given.text().split(",", -1)).map(String::strip).toList();
        if (names.stream().anyMatch(String::isBlank)) {
            throw words.problem(
                    given,
                    key + " is \"" + given.text() + "\", expected "
                            + (key.equals(SERVICE) ? "a name" : "names with commas between them"));
        }
        return names;
    }

    private static Map<String, Word> arguments(Kind kind, Words words) {
        List<String> known = Stream.concat(
                        kind.parameters().stream().map(Kind.Parameter::name), Stream.of(SERVICE, CAPABILITIES))
                .toList();
        Map<String, Word> arguments = new LinkedHashMap<>();
        while (words.hasNext()) {
            Word word = words.next("PARAMETER=VALUE");
            int equals = word.text().indexOf('=');
            if (equals < 1) {
                throw words.problem(word, "found \"" + word.text() + "\", expected PARAMETER=VALUE");
            }
            String key = word.text().substring(0, equals);
            if (!known.contains(key)) {
                throw words.problem(word, kind.name() + " has no parameter \"" + key + "\"; " + Hints.of(key, known));
            }
            if (arguments.put(key, new Word(word.text().substring(equals + 1), word.column())) != null) {
                throw words.problem(word, "\"" + key + "\" is given twice, expected it once");
            }
        }
        return arguments;
    }
}
