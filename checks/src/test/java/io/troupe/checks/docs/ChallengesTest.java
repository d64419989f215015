package io.troupe.checks.docs;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import io.troupe.checks.TestMethods;
import java.io.IOException;
import java.nio.file.Files;
import java.util.List;
import org.junit.jupiter.api.Test;

/** The page about the paper's six challenges contains all of them, each with tests that exist. */
class ChallengesTest {
    private static List<String> rows() throws IOException {
        return Files.readAllLines(Repository.root().resolve("docs/guide/10-challenges.md")).stream()
                .filter(line -> line.startsWith("| ["))
                .toList();
    }

    @Test
    void everyChallenge_namesTests() throws IOException {
        var rows = rows();
        assertThat(rows)
                .extracting(row -> row.substring(2, row.indexOf(']') + 1))
                .containsExactly("[i]", "[ii]", "[iii]", "[iv]", "[v]", "[vi]");
        assertThat(rows).allMatch(row -> !TestMethods.namedIn(row).isEmpty());
    }

    @Test
    void everyTestNamed_exists() throws IOException {
        assertThat(TestMethods.missing(String.join("\n", rows())))
                .as("tests that the page names and that do not exist")
                .isEmpty();
    }
}
