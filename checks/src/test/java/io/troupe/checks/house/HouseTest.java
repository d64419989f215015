package io.troupe.checks.house;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import io.troupe.checks.house.HouseFigures.Comment;
import io.troupe.checks.house.HouseFigures.SourceFile;
import java.io.IOException;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;

/** The limits that the sources keep; {@link HouseFigures} finds what breaks them. */
class HouseTest {
    private static List<SourceFile> sources = List.of();

    @BeforeAll
    static void read() throws IOException {
        sources = HouseFigures.read(Repository.root());
        assertThat(sources).filteredOn(SourceFile::isMain).hasSizeGreaterThan(400);
        assertThat(sources).filteredOn(each -> !each.isMain()).hasSizeGreaterThan(300);
    }

    @Test
    void commentLines_haveAtMost120Columns() {
        assertThat(HouseFigures.longCommentLines(sources)).isEmpty();
    }

    @Test
    void finder_readsCommentsAndNothingElse() {
        String code = """
                /** One. */ int a = '"' + "// no";  // two
                String s = \"""
                    /* no */ \\\""" \""";
                /* three
                   %s */
                """.formatted("x".repeat(118));
        List<Comment> comments = new ArrayList<>();
        String rest = SourceFile.withoutComments(code, comments);
        assertThat(comments).extracting(Comment::firstLine).containsExactly(1, 1, 4);
        assertThat(comments).extracting(Comment::words).element(0).isEqualTo("One.");
        assertThat(comments.getLast().lastColumn()).isEqualTo(124);
        assertThat(rest).doesNotContain("no", "two", "three").contains("int a", "String s");
    }

    @Test
    void finder_findsHouseWords_butNotInCode() {
        var comment = new Comment(7, 60, "/** Whoever listens is told; {@code nobody()} is a name. */");
        var file = new SourceFile(
                java.nio.file.Path.of("a/src/main/java/A.java"),
                "a",
                9,
                List.of(),
                List.of(comment),
                java.util.Set.of());
        assertThat(HouseFigures.houseWordsIn(List.of(file)))
                .hasSize(2)
                .anyMatch(each -> each.startsWith("a/src/main/java/A.java:7: \"Whoever\", better: "))
                .anyMatch(each -> each.contains("\"is told\""));
    }
}
