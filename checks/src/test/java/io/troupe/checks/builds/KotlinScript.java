package io.troupe.checks.builds;

import java.util.ArrayList;
import java.util.List;

/**
 * Splits a plain Gradle script into its statements. It knows comments, strings and brackets, and nothing else of
 * Kotlin.
 */
final class KotlinScript {
    /** {@code head { body }} if {@code block} is true, otherwise a head alone. */
    record Statement(String head, boolean block, String body) {
        List<Statement> inner(String file) {
            return statements(file, body);
        }
    }

    private KotlinScript() {}

    static List<Statement> statements(String file, String script) {
        var text = withoutComments(script);
        var statements = new ArrayList<Statement>();
        int start = 0;
        int depth = 0;
        for (int i = 0; i < text.length(); i++) {
            char c = text.charAt(i);
            if (c == '"') {
                i = endOfString(text, i);
            } else if ("({[".indexOf(c) >= 0) {
                depth++;
            } else if (")}]".indexOf(c) >= 0 && --depth < 0) {
                throw new BuildFileException(file + ": a " + c + " that nothing opened");
            } else if ((c == '\n' || c == ';') && depth == 0) {
                add(statements, text.substring(start, i));
                start = i + 1;
            }
        }
        if (depth != 0) {
            throw new BuildFileException(file + ": a bracket is not closed");
        }
        add(statements, text.substring(start));
        return statements;
    }

    private static void add(List<Statement> statements, String text) {
        var trimmed = text.strip();
        if (trimmed.isEmpty()) {
            return;
        }
        int brace = openingBrace(trimmed);
        if (brace < 0) {
            statements.add(new Statement(trimmed, false, ""));
        } else {
            statements.add(new Statement(
                    trimmed.substring(0, brace).strip(), true, trimmed.substring(brace + 1, trimmed.length() - 1)));
        }
    }

    /**
     * The start of the block that ends the statement, or -1. The brace must be outside of strings and other brackets.
     */
    private static int openingBrace(String statement) {
        if (!statement.endsWith("}")) {
            return -1;
        }
        int depth = 0;
        int last = -1;
        for (int i = 0; i < statement.length(); i++) {
            char c = statement.charAt(i);
            if (c == '"') {
                i = endOfString(statement, i);
            } else if ("({[".indexOf(c) >= 0) {
                if (c == '{' && depth == 0) {
                    last = i;
                }
                depth++;
            } else if (")}]".indexOf(c) >= 0) {
                depth--;
            }
        }
        return last;
    }

    private static String withoutComments(String text) {
        var kept = new StringBuilder();
        int i = 0;
        while (i < text.length()) {
            if (text.charAt(i) == '"') {
                int end = endOfString(text, i);
                kept.append(text, i, end + 1);
                i = end + 1;
            } else if (text.startsWith("//", i)) {
                int end = text.indexOf('\n', i);
                i = end < 0 ? text.length() : end;
            } else if (text.startsWith("/*", i)) {
                int end = text.indexOf("*/", i + 2);
                i = end < 0 ? text.length() : end + 2;
            } else {
                kept.append(text.charAt(i++));
            }
        }
        return kept.toString();
    }

    private static int endOfString(String text, int start) {
        if (text.startsWith("\"\"\"", start)) {
            throw new BuildFileException("a raw string is not understood here");
        }
        for (int i = start + 1; i < text.length() && text.charAt(i) != '\n'; i++) {
            if (text.charAt(i) == '\\') {
                i++;
            } else if (text.charAt(i) == '"') {
                return i;
            }
        }
        throw new BuildFileException("a string is not closed: "
                + text.substring(start).lines().findFirst().orElse(""));
    }
}
