package io.troupe.checks.format;

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
import org.junit.jupiter.api.Test;

/** All Java sources look as palantir-java-format prints them, imports sorted and in use. */
class FormatTest {
    private static final JavaFormatterOptions.Style STYLE = JavaFormatterOptions.Style.PALANTIR;
    private static final Formatter FORMATTER = Formatter.createFormatter(
            JavaFormatterOptions.builder().style(STYLE).build());

    /** With {@code -Dformat=write}, which the profile {@code format} sets, the sources are rewritten instead of judged. */
    @Test
    void sources_areFormatted() throws IOException {
        var write = System.getProperty("format", "check").equals("write");
        List<Path> unformatted = new ArrayList<>();
        for (Path source : sources()) {
            var text = Files.readString(source);
            var formatted = formatted(source, text);
            if (!formatted.equals(text)) {
                if (write) {
                    Files.writeString(source, formatted);
                } else {
                    unformatted.add(Repository.root().relativize(source));
                }
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

    private static String formatted(Path file, String source) {
        try {
            return formatted(source);
        } catch (FormatterException failure) {
            throw new AssertionError(file + ": " + failure.getMessage(), failure);
        }
    }

    private static String formatted(String source) throws FormatterException {
        var sorted = ImportOrderer.reorderImports(source, STYLE);
        return FORMATTER.formatSource(RemoveUnusedImports.removeUnusedImports(sorted));
    }

    private static List<Path> sources() {
        var sources = Repository.javaSources();
        assertThat(sources).as("Java sources of the repository").isNotEmpty();
        return sources;
    }
}
