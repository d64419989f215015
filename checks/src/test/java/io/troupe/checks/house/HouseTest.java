package io.troupe.checks.house;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.entry;
import static org.assertj.core.api.Assertions.tuple;

import io.troupe.checks.Repository;
import io.troupe.checks.house.HouseFigures.Comment;
import io.troupe.checks.house.HouseFigures.Literal;
import io.troupe.checks.house.HouseFigures.SourceFile;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** The limits that the sources keep; {@link HouseFigures} finds what breaks them. */
class HouseTest {
    private static List<SourceFile> sources = List.of();

    @BeforeAll
    static void read() throws IOException {
        sources = HouseFigures.read(Repository.root());
        assertThat(sources).filteredOn(SourceFile::isMain).hasSizeGreaterThan(1_000);
        assertThat(sources).filteredOn(each -> !each.isMain()).hasSizeGreaterThan(300);
    }

    @Test
    void sources_haveShortCommentLines_differentTypeNames_andNameThingsByTheirNouns() {
        assertThat(HouseFigures.longCommentLines(sources)).isEmpty();
        assertThat(new HouseFigures(sources).namesThatExistTwice()).isEmpty();
        assertThat(HouseFigures.houseWordsIn(sources)).isEmpty();
    }

    @Test
    void methodsOfMainCode_haveFewerThan60Lines_andNoCommentEndsWithALonelyWord() {
        assertThat(HouseFigures.longMethods(sources)).isEmpty();
        assertThat(HouseFigures.brokenComments(sources)).isEmpty();
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
    void figures_countPublicAndInternalTypes_codeLines_andTestMethods(@TempDir Path folder) throws IOException {
        write(folder.resolve("m/src/main/java/p/A.java"), """
                package p;

                /** One. */
                public class A { // two
                    String s = \"""
                            a text
                            \""";
                }
                """);
        write(folder.resolve("m/src/main/java/p/internal/B.java"), "package p.internal;\npublic interface B {}\n");
        write(folder.resolve("m/src/test/java/p/ATest.java"), """
                package p;
                class ATest {
                    @Test void one() {}
                    @Nested class Inner { @org.junit.jupiter.api.RepeatedTest(2) void two() {} }
                    void helper() {}
                }
                """);
        var house = new HouseFigures(HouseFigures.read(folder));
        assertThat(house.figures())
                .containsEntry("main files", "2")
                .containsEntry("lines of them", "10")
                .containsEntry("lines with code, neither blank nor comment alone", "8")
                .containsEntry("public types", "2")
                .containsEntry("public types in packages called `internal`", "1")
                .containsEntry("lines of test code", "6")
                .containsEntry("test methods", "2");
        assertThat(house.modules()).hasSize(3).last().isEqualTo("| m | 2 | 10 | 8 | 2 | 1 | 1 | 6 | 2 |");
    }

    /** The page is filled in by hand, from what the script prints. */
    @Test
    void pageAboutTheSources_hasTheFiguresThatTheScriptPrints() throws IOException {
        var rows = Repository.text("docs/house.md")
                .lines()
                .filter(line -> line.startsWith("| "))
                .map(line -> line.split(" \\| ")[0].substring(2));
        var figures = new HouseFigures(List.of()).figures();
        assertThat(rows).containsSubsequence(figures.keySet());
    }

    private static void write(Path file, String text) throws IOException {
        Files.createDirectories(file.getParent());
        Files.writeString(file, text);
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
        List<Literal> texts = new ArrayList<>();
        String rest = SourceFile.withoutComments(code, comments, texts);
        assertThat(comments).extracting(Comment::firstLine).containsExactly(1, 1, 4);
        assertThat(comments).extracting(Comment::words).element(0).isEqualTo("One.");
        assertThat(comments.getLast().linesOver(123)).containsExactly(5);
        assertThat(comments.getLast().linesOver(124)).isEmpty();
        assertThat(texts).extracting(Literal::firstLine).containsExactly(1, 2);
        assertThat(texts).extracting(Literal::words).element(0).isEqualTo("// no");
        assertThat(texts.getLast().words()).startsWith("/* no */");
        assertThat(rest).doesNotContain("no", "two", "three").contains("int a", "String s");
    }

    @Test
    void finder_findsHouseWords_inCommentsAndTexts_butNotInCode() {
        var comment = new Comment(7, 0, "/** Whoever listens is told; {@code nobody()} is a name. */");
        var texts = List.of(
                new Literal(8, "\"\"\"\n    the caller hears\\nnothing\"\"\""),
                new Literal(9, "\"say\""),
                new Literal(9, "\"a caller\""));
        assertThat(HouseFigures.houseWordsIn(List.of(file("a/src/main/java/A.java", comment, texts))))
                .hasSize(3)
                .anyMatch(each -> each.startsWith("a/src/main/java/A.java:8: \"hears\", better: "))
                .anyMatch(each -> each.startsWith("a/src/main/java/A.java:7: \"Whoever\", better: "))
                .anyMatch(each -> each.contains("\"is told\""));
    }

    private static SourceFile file(String path, Comment comment, List<Literal> texts) {
        return new SourceFile(Path.of(path), "a", 9, 8, 0, List.of(), List.of(comment), texts, Set.of(), List.of());
    }

    @Test
    void testsOfAnEarlierTree_areFoundByTheirNames_orByTheirWords_onceEach(@TempDir Path folder) throws IOException {
        write(folder.resolve("before/m/src/test/java/p/ATest.java"), """
                class ATest {
                    @Test void kept() { check(1, "colour"); }
                    @Test void renamed() { robot.drive(ahead); assertThat(robot.stall()).isTrue(); }
                    @Test void gone() { nothing.like(it); }
                }
                """);
        write(folder.resolve("now/m/src/test/java/p/BTest.java"), """
                class BTest {
                    @Test
                    void kept() {
                        other();
                    }
                    @Test void stalls() { robot.drive(ahead); assertThat(robot.stall()).isTrue(); }
                    @Test void added() { robot.drive(ahead); }
                    void helper() {}
                }
                """);
        write(folder.resolve("now/m/src/main/java/p/B.java"), "class B { @Test void gone() {} }");
        var before = KeptTests.read(folder.resolve("before"));
        var now = KeptTests.read(folder.resolve("now"));
        assertThat(now.lines()).isEqualTo(9);
        assertThat(now.methods())
                .extracting(KeptTests.TestMethod::name, KeptTests.TestMethod::lines)
                .containsExactly(tuple("kept", 4), tuple("stalls", 1), tuple("added", 1));
        Map<String, String> names = new TreeMap<>();
        KeptTests.kept(before.methods(), now.methods()).forEach((old, each) -> names.put(old.name(), each.name()));
        assertThat(names).containsExactly(entry("kept", "kept"), entry("renamed", "stalls"));
    }
}
