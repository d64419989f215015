package io.troupe.petri.drawing;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/** Reads the part of the DOT language that the drawings use, and rejects everything else. */
final class DotReader {
    /** A node, an edge, or the defaults; attributes as Graphviz would show them. */
    record Statement(List<String> nodes, Map<String, String> attributes) {}

    private final String text;
    private int at;

    private DotReader(String text) {
        this.text = text;
    }

    static List<Statement> read(String dot) {
        var reader = new DotReader(dot);
        reader.expect("digraph");
        reader.expect("{");
        var statements = new ArrayList<Statement>();
        while (!reader.accept("}")) {
            statements.add(reader.statement());
        }
        reader.space();
        if (reader.at != dot.length()) {
            throw new AssertionError("text after the end: " + dot.substring(reader.at));
        }
        return statements;
    }

    private Statement statement() {
        var nodes = new ArrayList<String>();
        nodes.add(value());
        while (accept("->")) {
            nodes.add(value());
        }
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
        space();
        if (text.charAt(at) == '"') {
            return quoted();
        }
        var start = at;
        while (Character.isLetterOrDigit(text.charAt(at)) || text.charAt(at) == '.') {
            at++;
        }
        if (at == start) {
            throw new AssertionError("expected a name at: " + text.substring(at));
        }
        return text.substring(start, at);
    }

    private String quoted() {
        var value = new StringBuilder();
        at++;
        while (text.charAt(at) != '"') {
            var character = text.charAt(at++);
            if (character != '\\') {
                value.append(character);
                continue;
            }
            var escaped = text.charAt(at++);
            switch (escaped) {
                case 'n' -> value.append('\n');
                case '\\', '"' -> value.append(escaped);
                default -> throw new AssertionError("\\" + escaped + " means something to Graphviz");
            }
        }
        at++;
        // the entities that Graphviz would replace, the first one last
        return value.toString().replace("&amp;", "&");
    }

    private void expect(String token) {
        if (!accept(token)) {
            throw new AssertionError("expected " + token + " at: " + text.substring(at));
        }
    }

    private boolean accept(String token) {
        space();
        var there = text.startsWith(token, at);
        at += there ? token.length() : 0;
        return there;
    }

    private void space() {
        while (at < text.length() && Character.isWhitespace(text.charAt(at))) {
            at++;
        }
    }
}
