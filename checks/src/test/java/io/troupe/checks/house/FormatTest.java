package io.troupe.checks.house;

import static org.assertj.core.api.Assertions.assertThat;

import com.palantir.javaformat.java.Formatter;
import com.palantir.javaformat.java.FormatterException;
import com.palantir.javaformat.java.ImportOrderer;
import com.palantir.javaformat.java.JavaFormatterOptions;
import com.palantir.javaformat.java.RemoveUnusedImports;
import io.troupe.checks.Repository;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Pattern;
import org.junit.jupiter.api.Test;

/** All Java sources are formatted by palantir-java-format, with Javadoc, sorted imports and no unused ones. */
class FormatTest {
    private static final JavaFormatterOptions.Style STYLE = JavaFormatterOptions.Style.PALANTIR;
    /** The start of a snippet: first in its line of a Javadoc comment. */
    private static final Pattern SNIPPET = Pattern.compile("(?m)^ *\\* (\\{@snippet)");
    /** Marks a protected snippet; concatenated so that this file does not contain it. */
    private static final String PRE = "<pre " + "id=snippet>";

    private static final String PRE_END = "</pre>";
    private static final Formatter FORMATTER = Formatter.createFormatter(
            JavaFormatterOptions.builder().style(STYLE).formatJavadoc(true).build());

    /**
     * With {@code -Dformat=write}, which the profile {@code format} sets, the sources are rewritten instead of checked.
     */
    @Test
    void sources_areFormatted() throws IOException {
        var write = System.getProperty("format", "check").equals("write");
        List<Path> unformatted = new ArrayList<>();
        assertThat(Repository.javaSources()).isNotEmpty();
        for (Path source : Repository.javaSources()) {
            var text = Files.readString(source);
            var formatted = formatted(source, text);
            if (write && !formatted.equals(text)) {
                Files.writeString(source, formatted);
            } else if (!formatted.equals(text)) {
                unformatted.add(Repository.root().relativize(source));
            }
        }
        assertThat(unformatted)
                .as("unformatted sources; format them by `mvn -q -ntp test -Pformat`")
                .isEmpty();
    }

    @Test
    void formatter_sortsImportsAndDropsUnusedOnes() throws FormatterException {
        assertThat(formatted("import java.util.Set;\nimport java.util.List;\nimport java.util.Map;\n"
                        + "interface A { List<Map<Integer, Integer>> all(int a, int b); }"))
                .isEqualTo("""
                        import java.util.List;
                        import java.util.Map;

                        interface A {
                            List<Map<Integer, Integer>> all(int a, int b);
                        }
                        """);
    }

    @Test
    void formatter_fillsJavadoc_butLeavesSnippetsAsTheyAre() throws FormatterException {
        String snippet = """
                 * {@snippet :
                 * class A { // {nested} braces
                 *     int a;
                 * }
                 * }
                """;
        String formatted = formatted("/**\n * " + "word ".repeat(30).strip() + "\n *\n" + snippet.stripTrailing()
                + "\n *\n * <p>End.\n */\ninterface A {}\n");
        assertThat(formatted.lines()).allMatch(line -> line.length() <= 120).hasSize(13);
        assertThat(formatted).contains(snippet.stripTrailing() + "\n *\n * <p>End.\n */");
        assertThat(formatted(formatted)).isEqualTo(formatted);
    }

    private static String formatted(Path file, String source) {
        try {
            return formatted(source);
        } catch (FormatterException failure) {
            throw new AssertionError(file + ": " + failure.getMessage(), failure);
        }
    }

    private static String formatted(String source) throws FormatterException {
        var sorted = ImportOrderer.reorderImports(source, STYLE);
        var protectedSnippets = withSnippetsInPre(RemoveUnusedImports.removeUnusedImports(sorted));
        return withoutPreAroundSnippets(FORMATTER.formatSource(protectedSnippets));
    }

    /**
     * Protects snippets in Javadoc, whose lines the formatter would fill: it does not know them, but it leaves
     * {@code pre} alone.
     */
    private static String withSnippetsInPre(String source) {
        var result = new StringBuilder();
        int end = 0;
        for (var start = SNIPPET.matcher(source); start.find(end); ) {
            result.append(source, end, start.start(1)).append(PRE);
            end = endOfBraces(source, start.start(1));
            result.append(source, start.start(1), end).append(PRE_END);
        }
        return result.append(source.substring(end)).toString();
    }

    private static String withoutPreAroundSnippets(String source) {
        var result = new StringBuilder();
        int end = 0;
        for (int start; (start = source.indexOf(PRE, end)) >= 0; ) {
            int snippetEnd = endOfBraces(source, start + PRE.length());
            result.append(source, end, start).append(source, start + PRE.length(), snippetEnd);
            end = snippetEnd + PRE_END.length();
        }
        return result.append(source.substring(end)).toString();
    }

    /** The index after the brace that closes the one at {@code start}. */
    private static int endOfBraces(String source, int start) {
        int end = start;
        int open = 0;
        do {
            char character = source.charAt(end++);
            open += character == '{' ? 1 : character == '}' ? -1 : 0;
        } while (open > 0);
        return end;
    }
}
