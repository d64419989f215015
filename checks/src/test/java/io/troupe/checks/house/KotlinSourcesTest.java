package io.troupe.checks.house;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Pattern;
import org.junit.jupiter.api.Test;

/** Kotlin sources have the form that needs no formatter to be checked, and name things as the Java sources do. */
class KotlinSourcesTest {
    private static final Pattern COMMENT = Pattern.compile("(?s)/\\*.*?\\*/|//[^\\n]*");
    private static final Pattern CODE = Pattern.compile("(?s)```.*?```|`[^`]*`|\\[[^]]*]|\"[^\"\\n]*\"");

    @Test
    void sources_haveTheFormOfKotlin_andNameThingsByTheirNouns() throws IOException {
        List<String> problems = new ArrayList<>();
        List<Path> sources = Repository.kotlinSources().stream()
                .filter(source -> !source.endsWith("Greeter.kt")) // kept compiled with its digest
                .toList();
        assertThat(sources).hasSizeGreaterThan(8);
        for (Path source : sources) {
            problems.addAll(problems(Repository.root().relativize(source).toString(), Files.readString(source)));
        }
        assertThat(problems).isEmpty();
    }

    @Test
    void problems_areNamedWithTheirLines() {
        String text =
                "package p\n\nimport b.C\nimport a.*\nimport a.B\n\tval a = 1 \n// somebody hears\n" + "x".repeat(121);
        assertThat(problems("A.kt", text))
                .containsExactlyInAnyOrder(
                        "A.kt:4: an import of a whole package",
                        "A.kt:5: imports are not sorted",
                        "A.kt:6: a tab",
                        "A.kt:6: white space at the end",
                        "A.kt:8: 121 columns",
                        "A.kt: no single line end at its end",
                        "A.kt:7: \"somebody\", better: " + better("somebody"),
                        "A.kt:7: \"hears\", better: " + better("hears"));
    }

    private static String better(String word) {
        return HouseFigures.HOUSE_WORDS.entrySet().stream()
                .filter(each -> each.getKey().matcher(word).find())
                .findFirst()
                .orElseThrow()
                .getValue();
    }

    private static List<String> problems(String file, String text) {
        List<String> problems = new ArrayList<>();
        String before = "";
        int number = 0;
        for (String line : text.lines().toList()) {
            String place = file + ":" + ++number + ": ";
            if (line.startsWith("import ")) {
                if (line.endsWith(".*")) {
                    problems.add(place + "an import of a whole package");
                } else if (line.compareTo(before) < 0) {
                    problems.add(place + "imports are not sorted");
                }
                before = line.endsWith(".*") ? before : line;
            }
            if (line.contains("\t")) {
                problems.add(place + "a tab");
            }
            if (!line.equals(line.stripTrailing())) {
                problems.add(place + "white space at the end");
            }
            if (line.length() > HouseFigures.COMMENT_COLUMNS) {
                problems.add(place + line.length() + " columns");
            }
        }
        if (!text.endsWith("\n") || text.endsWith("\n\n")) {
            problems.add(file + ": no single line end at its end");
        }
        COMMENT.matcher(text).results().forEach(comment -> {
            long line = 1
                    + text.substring(0, comment.start())
                            .chars()
                            .filter(each -> each == '\n')
                            .count();
            String words = CODE.matcher(comment.group()).replaceAll(" ");
            HouseFigures.HOUSE_WORDS.forEach((pattern, better) -> pattern.matcher(words)
                    .results()
                    .forEach(hit -> problems.add(file + ":" + line + ": \"" + hit.group() + "\", better: " + better)));
        });
        return problems;
    }
}
