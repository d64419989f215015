package io.troupe.checks.docs;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import java.io.IOException;
import java.nio.file.Files;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Pattern;
import org.junit.jupiter.api.Test;

/** The numbers of lines in the guide on Kotlin are those of the sources that they link to. */
class CodeLinesTest {
    private static final Pattern COUNTED = Pattern.compile("\\[(\\d+)]\\(([^)]*\\.(?:kt|java))\\)");
    private static final Pattern COMMENT = Pattern.compile("(?s)/\\*.*?\\*/|//[^\\n]*");

    @Test
    void numbersOfLines_areThoseOfTheSources() throws IOException {
        var guide = Repository.root().resolve("docs/guide");
        var numbers = COUNTED.matcher(Repository.text("docs/guide/14-kotlin.md"));
        List<String> stated = new ArrayList<>();
        List<String> counted = new ArrayList<>();
        while (numbers.find()) {
            stated.add(numbers.group(2) + ": " + numbers.group(1));
            counted.add(numbers.group(2) + ": "
                    + linesOfCode(
                            Files.readString(guide.resolve(numbers.group(2)).normalize())));
        }
        assertThat(stated).hasSizeGreaterThan(7).isEqualTo(counted);
    }

    @Test
    void linesOfCode_areThoseWithoutImportsCommentsAndEmptyLines() {
        assertThat(linesOfCode("package p;\n\nimport a.B;\n/** What.\n * it is */\nclass A { // one\n\n // no\n}\n"))
                .isEqualTo(2);
    }

    private static long linesOfCode(String source) {
        return COMMENT.matcher(source)
                .replaceAll("")
                .lines()
                .map(String::strip)
                .filter(line -> !line.isEmpty() && !line.startsWith("import ") && !line.startsWith("package "))
                .count();
    }
}
