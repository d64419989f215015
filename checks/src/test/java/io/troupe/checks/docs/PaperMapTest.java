package io.troupe.checks.docs;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import java.io.IOException;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Pattern;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;

/** The map of the paper has a row for each of its figures, tables and challenges, and for the units of section 2. */
class PaperMapTest {
    private static final Pattern ROW =
            Pattern.compile("(?m)^\\| ([^|]+?) \\| ([^|]*?) \\| ([^|]*?) \\| ([^|]*?) ?\\|$");

    private static final Stream<String> UNITS = Stream.of(
            "service layer",
            "communication layer",
            "application layer",
            "service",
            "interface",
            "CCU",
            "DCU",
            "BCU",
            "bus",
            "broker");

    @Test
    void map_hasARowForEveryFigureTableChallengeAndUnit_inTheirOrder() throws IOException {
        String page = Repository.text("docs/guide/19-map-of-the-paper.md");
        assertThat(rows(page, "Figure")).isEqualTo(numbered("Figure", 39));
        assertThat(rows(page, "Table")).containsExactlyInAnyOrderElementsOf(numbered("Table", 4));
        assertThat(rows(page, "challenge"))
                .isEqualTo(Stream.of("i", "ii", "iii", "iv", "v", "vi")
                        .map(each -> "challenge [" + each + "]")
                        .toList());
        List<String> all = rows(page, "");
        assertThat(all).containsAll(UNITS.toList());
        assertThat(all.stream().filter("claim"::equals)).hasSizeGreaterThan(25);
    }

    @Test
    void rowWithoutAWordOrAPlace_isNone() {
        assertThat(rows(
                        "| Figure 1 | says | here | |\n| Figure 2 | | here | |\n| Figure 3 | says | | [a](b) |\n",
                        "Figure"))
                .containsExactly("Figure 1");
    }

    private static List<String> numbered(String kind, int last) {
        return IntStream.rangeClosed(1, last)
                .mapToObj(each -> kind + " " + each)
                .toList();
    }

    /** The first cells of rows that begin so, if the second and the third cell have something. */
    private static List<String> rows(String page, String kind) {
        List<String> rows = new ArrayList<>();
        ROW.matcher(page).results().forEach(row -> {
            if (row.group(1).startsWith(kind)
                    && !row.group(2).isBlank()
                    && !row.group(3).isBlank()) {
                rows.add(row.group(1));
            }
        });
        return rows;
    }
}
