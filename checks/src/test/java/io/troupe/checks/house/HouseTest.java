package io.troupe.checks.house;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import io.troupe.checks.house.HouseFigures.Comment;
import io.troupe.checks.house.HouseFigures.SourceFile;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;
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
    void topLevelTypesOfMainCode_haveDifferentNames() {
        assertThat(new HouseFigures(sources).namesThatExistTwice()).isEmpty();
    }

    @Test
    void comments_nameThingsByTheirNouns() {
        assertThat(HouseFigures.houseWordsIn(sources)).isEmpty();
    }

    @Test
    void markdownPages_haveParagraphsOfOneLine_andNameThingsByTheirNouns() throws IOException {
        List<String> problems = new ArrayList<>();
        List<Path> pages = Repository.markdownPages();
        assertThat(pages).hasSizeGreaterThan(20);
        for (Path page : pages) {
            String name = Repository.root().relativize(page).toString();
            problems.addAll(HouseFigures.markdownProblems(name, Files.readString(page)));
        }
        assertThat(problems).isEmpty();
    }

    @Test
    void finder_readsMarkdownProse_butNotCode() {
        String text = """
                # Says

                %s
                more `nobody`

                ```
                whoever
                ```
                """.formatted("long ".repeat(21));
        assertThat(HouseFigures.markdownProblems("a.md", text))
                .hasSize(2)
                .anyMatch(each -> each.startsWith("a.md:1: \"Says\""))
                .anyMatch(each -> each.startsWith("a.md:4: a broken paragraph"));
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
        var file = new SourceFile(Path.of("a/src/main/java/A.java"), "a", 9, List.of(), List.of(comment), Set.of());
        assertThat(HouseFigures.houseWordsIn(List.of(file)))
                .hasSize(2)
                .anyMatch(each -> each.startsWith("a/src/main/java/A.java:7: \"Whoever\", better: "))
                .anyMatch(each -> each.contains("\"is told\""));
    }
}
