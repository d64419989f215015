package io.troupe.checks.builds;

import io.troupe.checks.builds.Build.NotUnderstood;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Pattern;

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

    private static final Pattern COMMENT = Pattern.compile("//.*|(?s:/\\*.*?(?:\\*/|$))");
    private static final Pattern STRING = Pattern.compile("\"(?:[^\"\\\\\\n]|\\\\.)*\"");
    private static final Pattern TOKEN = Pattern.compile(COMMENT + "|\"\"\"|" + STRING + "|(?s:.)");

    private KotlinScript() {}

    static List<Statement> statements(String file, String script) {
        var statements = new ArrayList<Statement>();
        var text = new StringBuilder();
        int depth = 0;
        int brace = -1; // where the last block of the statement begins
        for (var match : TOKEN.matcher(script + "\n").results().toList()) {
            var token = match.group();
            if (token.equals("\"\"\"")) {
                throw new NotUnderstood("a raw string is not understood here");
            } else if (token.equals("\"")) {
                var line = script.substring(match.start()).lines().findFirst().orElse("");
                throw new NotUnderstood("a string is not closed: " + line);
            } else if ("({[".contains(token)) {
                brace = token.equals("{") && depth == 0 ? text.length() : brace;
                depth++;
            } else if (")}]".contains(token) && --depth < 0) {
                throw new NotUnderstood(file + ": a " + token + " that nothing opened");
            }
            if ((token.equals("\n") || token.equals(";")) && depth == 0) {
                add(statements, text.toString().stripTrailing(), brace);
                text.setLength(0);
                brace = -1;
            } else if (!COMMENT.matcher(token).matches()) {
                text.append(token);
            }
        }
        if (depth != 0) {
            throw new NotUnderstood(file + ": a bracket is not closed");
        }
        return statements;
    }

    private static void add(List<Statement> statements, String text, int brace) {
        if (brace >= 0 && text.endsWith("}")) {
            statements.add(new Statement(
                    text.substring(0, brace).strip(), true, text.substring(brace + 1, text.length() - 1)));
        } else if (!text.isBlank()) {
            statements.add(new Statement(text.strip(), false, ""));
        }
    }
}
