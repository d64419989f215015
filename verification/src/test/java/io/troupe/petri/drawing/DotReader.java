package io.troupe.petri.drawing;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Queue;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/** Reads the part of the DOT language that the drawings use, and rejects everything else. */
final class DotReader {
    /** A node, an edge, or the defaults; attributes as Graphviz would show them. */
    record Statement(List<String> nodes, Map<String, String> attributes) {}

    /** Of the escapes in quoted text, only these three mean nothing to Graphviz. */
    private static final Pattern TOKEN =
            Pattern.compile("\\G\\s*(\"(?:[^\"\\\\]|\\\\[n\"\\\\])*\"|->|[{}\\[\\]=,;]|[\\p{L}\\p{Nd}.]+)");

    private static final Pattern ESCAPE = Pattern.compile("\\\\(.)");

    private final Queue<String> tokens = new ArrayDeque<>();

    static List<Statement> read(String dot) {
        var reader = new DotReader();
        var rest = TOKEN.matcher(dot).replaceAll(token -> {
            reader.tokens.add(token.group(1));
            return "";
        });
        assertThat(rest).as("what is not understood").isBlank();
        reader.expect("digraph");
        reader.expect("{");
        var statements = new ArrayList<Statement>();
        while (!reader.accept("}")) {
            statements.add(reader.statement());
        }
        assertThat(reader.tokens).as("text after the end").isEmpty();
        return statements;
    }

    private Statement statement() {
        var nodes = new ArrayList<String>();
        do {
            nodes.add(value());
        } while (accept("->"));
        var attributes = new LinkedHashMap<String, String>();
        expect("[");
        while (!accept("]")) {
            var name = value();
            expect("=");
            attributes.put(name, value());
            accept(",");
        }
        expect(";");
        return new Statement(nodes, attributes);
    }

    private String value() {
        var token = tokens.remove();
        assertThat(token).as("a name").doesNotMatch("->|[{}\\[\\]=,;]");
        if (!token.startsWith("\"")) {
            return token;
        }
        var text = ESCAPE.matcher(token.substring(1, token.length() - 1))
                .replaceAll(escape -> Matcher.quoteReplacement(escape.group(1).replace('n', '\n')));
        // the entities that Graphviz would replace, the first one last
        return text.replace("&amp;", "&");
    }

    private void expect(String token) {
        assertThat(tokens.remove()).isEqualTo(token);
    }

    private boolean accept(String token) {
        return token.equals(tokens.element()) && token.equals(tokens.remove());
    }
}
