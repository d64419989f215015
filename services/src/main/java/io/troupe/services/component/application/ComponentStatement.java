package io.troupe.services.component.application;

import io.troupe.services.component.Component;
import io.troupe.services.component.application.LineTokens.Token;
import io.troupe.services.component.kinds.ArgumentException;
import io.troupe.services.component.kinds.Arguments;
import io.troupe.services.component.kinds.ComponentKind;
import io.troupe.services.component.kinds.ComponentKinds;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;

/**
 * The statement {@code component NAME is KIND [PARAMETER=VALUE ..]}.
 *
 * @param kind the token that names the kind
 */
record ComponentStatement(String name, Token kind, Component<?, ?> component) {
    private static final String SERVICE = "service";
    private static final String CAPABILITIES = "capabilities";

    /** Parses the rest of the line after the word {@code component}. */
    static ComponentStatement read(LineTokens tokens, ComponentKinds kinds, Path directory) {
        String name = tokens.name("the component's name");
        tokens.expect("is");
        Token kindToken = tokens.next("a kind of component");
        ComponentKind kind = kinds.find(kindToken.text())
                .orElseThrow(() -> tokens.error(
                        kindToken,
                        "there is no kind of component \"" + kindToken.text() + "\"; "
                                + Hints.of(
                                        kindToken.text(),
                                        kinds.all().stream()
                                                .map(ComponentKind::name)
                                                .toList())));
        Map<String, Token> arguments = arguments(kind, tokens);
        Map<String, String> given = new LinkedHashMap<>();
        arguments.forEach((key, token) -> given.put(key, token.text()));
        List<String> service = names(SERVICE, arguments, tokens);
        List<String> capabilities = names(CAPABILITIES, arguments, tokens);
        given.keySet().removeAll(List.of(SERVICE, CAPABILITIES));
        try {
            var made = kind.factory().create(name, new Arguments(kind, given, directory));
            var offered = made.offering(
                    service.isEmpty() ? made.service() : service.getFirst(),
                    capabilities.isEmpty() ? made.capabilities() : capabilities);
            return new ComponentStatement(name, kindToken, offered);
        } catch (ArgumentException wrong) {
            throw tokens.error(arguments.getOrDefault(wrong.parameter(), kindToken), wrong.getMessage());
        }
    }

    /** The comma-separated names given for a key; empty if the key is missing. */
    private static List<String> names(String key, Map<String, Token> arguments, LineTokens tokens) {
        Token given = arguments.get(key);
        if (given == null) {
            return List.of();
        }
        List<String> names = key.equals(SERVICE)
                ? List.of(given.text())
                : Arrays.stream(given.text().split(",", -1)).map(String::strip).toList();
        if (names.stream().anyMatch(String::isBlank)) {
            throw tokens.error(
                    given,
                    key + " is \"" + given.text() + "\", expected "
                            + (key.equals(SERVICE) ? "a name" : "names with commas between them"));
        }
        return names;
    }

    private static Map<String, Token> arguments(ComponentKind kind, LineTokens tokens) {
        List<String> known = Stream.concat(
                        kind.parameters().stream().map(ComponentKind.Parameter::name), Stream.of(SERVICE, CAPABILITIES))
                .toList();
        Map<String, Token> arguments = new LinkedHashMap<>();
        while (tokens.hasNext()) {
            Token token = tokens.next("PARAMETER=VALUE");
            int equals = token.text().indexOf('=');
            if (equals < 1) {
                throw tokens.error(token, "found \"" + token.text() + "\", expected PARAMETER=VALUE");
            }
            String key = token.text().substring(0, equals);
            if (!known.contains(key)) {
                throw tokens.error(token, kind.name() + " has no parameter \"" + key + "\"; " + Hints.of(key, known));
            }
            if (arguments.put(key, new Token(token.text().substring(equals + 1), token.column())) != null) {
                throw tokens.error(token, "\"" + key + "\" is given twice, expected it once");
            }
        }
        return arguments;
    }
}
