package io.troupe.checks.docs;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Set;
import java.util.regex.MatchResult;
import java.util.regex.Pattern;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/**
 * Every relative link of a Markdown page leads to a file or folder of the repository, and every anchor to a heading, as
 * GitHub computes it; and the methods that the walks of the architecture name are declared there. So a page that names
 * a source is corrected with the commit that renames the source.
 */
class DocumentLinksTest {
    private static final Pattern FENCE = Pattern.compile("(?ms)^ *```.*?^ *```$");
    private static final Pattern CODE = Pattern.compile("`[^`\n]*`");
    private static final Pattern LINK =
            Pattern.compile("\\]\\(([^()\\s]+)(?: \"[^\"]*\")?\\)|(?:src|href)=\"([^\"]+)\"");
    private static final Pattern STEP =
            Pattern.compile("((?:`\\w+`(?:, | and )?)+) (?:of|in) \\[\\w+]\\(([^)#]+\\.java)\\)");
    private static final Pattern NAME = Pattern.compile("`(\\w+)`");
    private static final Pattern ADDRESS = Pattern.compile("[a-z]+:.*");
    private static final Pattern HEADING = Pattern.compile("(?m)^#{1,6} +(.*?) *$");
    private static final Pattern LINE = Pattern.compile("L(\\d+)(?:-L(\\d+))?");

    @TempDir
    Path folder;

    @Test
    void relativeLinks_ofAllPages_leadToFilesAndHeadingsThatExist() throws IOException {
        List<String> broken = new ArrayList<>();
        int links = 0;
        for (Path page : Repository.markdownPages()) {
            links += links(Files.readString(page)).size();
            broken.addAll(brokenLinks(Repository.root(), page));
        }
        assertThat(links).as("links").isGreaterThan(100);
        assertThat(broken).as("links that lead nowhere").isEmpty();
    }

    /** The walks of this page lead through the code step by step. */
    @Test
    void architecture_linksToManySources_ofAllPublishedModules() throws IOException {
        var sources = links(Repository.text("docs/architecture.md")).stream()
                .filter(link -> link.endsWith(".java"))
                .toList();
        assertThat(sources).hasSizeGreaterThan(25);
        assertThat(List.of("actor-core", "actor-service", "playerlike-sim", "services", "verification", "demo"))
                .allSatisfy(module -> assertThat(sources).anyMatch(link -> link.startsWith("../" + module + "/")));
    }

    /** A step names methods, or types within a file, before the link to the file: {@code `tick` of [World](..)}. */
    @Test
    void architecture_namesMethodsThatTheLinkedFilesDeclare() throws IOException {
        String page = Repository.text("docs/architecture.md");
        List<String> missing = new ArrayList<>();
        int names = 0;
        for (MatchResult step : STEP.matcher(page).results().toList()) {
            String source = Files.readString(Repository.root().resolve("docs").resolve(step.group(2)));
            for (MatchResult name : NAME.matcher(step.group(1)).results().toList()) {
                names++;
                if (!declares(source, name.group(1))) {
                    missing.add(name.group(1) + " of " + step.group(2));
                }
            }
        }
        assertThat(names).as("names").isGreaterThan(80);
        assertThat(missing).as("not declared there").isEmpty();
    }

    @Test
    void declaration_isNoCall() {
        String source = "class A {\n    private List<String> one(int a) {\n        return two(a);\n    }\n}\n";
        assertThat(declares(source, "one")).isTrue();
        assertThat(declares(source, "two")).isFalse();
        assertThat(declares(source, "A")).isTrue();
    }

    private static boolean declares(String source, String name) {
        String types = "\\b(?:class|record|interface|enum) +" + name + "\\b";
        String methods = "(?m)^ +(?!return |throw |new |else )(?:[\\w<>?,.@\\[\\]&]+ )+" + name + "\\(";
        return Pattern.compile(types + "|" + methods).matcher(source).find();
    }

    /** The drawing names every module of the build, and every package of the libraries. */
    @Test
    void drawingOfTheRooms_namesAllModulesAndPackages() throws IOException {
        String drawing = Repository.text("docs/figures/rooms.svg");
        assertThat(Repository.modules())
                .hasSizeGreaterThan(8)
                .allSatisfy(module -> assertThat(drawing).containsPattern("[>\\s]" + module.getFileName() + "[,<]"));
        var packages = Repository.javaSources().stream()
                .map(source -> source.toString().replace('\\', '/'))
                .filter(source -> source.endsWith("/package-info.java") && source.contains("/src/main/java/"))
                .filter(source -> !source.matches(".*/(?:demo|jmh|stress|structures)/.*"))
                .map(source ->
                        source.replaceAll(".*/java/|/package-info.java", "").replace('/', '.'))
                .toList();
        assertThat(packages)
                .hasSizeGreaterThan(20)
                .allSatisfy(name -> assertThat(drawing).contains(">" + name + "<"));
    }

    /** Each package is named in full, or by its last parts: {@code `.promise`}; those of structures as one. */
    @Test
    void readmesOfTheModules_nameTheirPackages() throws IOException {
        List<String> unnamed = new ArrayList<>();
        int packages = 0;
        for (Path module : Repository.modules()) {
            String page = Files.readString(module.resolve("README.md"));
            for (Path source : Repository.files(module.resolve("src/main/java"), "package-info.java")) {
                String name = module.resolve("src/main/java")
                        .relativize(source.getParent())
                        .toString()
                        .replace('\\', '.')
                        .replace('/', '.')
                        .replaceAll("structures\\..*", "structures");
                packages++;
                boolean isNamed = page.contains("`" + name + "`")
                        || IntStream.range(0, name.length())
                                .filter(at -> name.charAt(at) == '.')
                                .anyMatch(at -> page.contains("`" + name.substring(at) + "`"));
                if (!isNamed) {
                    unnamed.add(module.getFileName() + ": " + name);
                }
            }
        }
        assertThat(packages).isGreaterThan(50);
        assertThat(unnamed)
                .as("packages that the README of their module does not name")
                .isEmpty();
    }

    @Test
    void brokenLinks_areNamed_butNotThoseInCode() throws IOException {
        Files.createDirectories(folder.resolve("docs"));
        Files.writeString(folder.resolve("docs/A.java"), "one\ntwo\n");
        Files.writeString(
                folder.resolve("other.md"), "# What `it` is: a page\n\n## Twice\n\n## Twice\n\n```\n# no\n```\n");
        Path page = folder.resolve("docs/page.md");
        Files.writeString(page, """
                [a](A.java) [b](A.java#L2) [c](../other.md#what-it-is-a-page) [d](../other.md#twice-1) [e](#here) [f](.)
                ![g](https://example.org/x.svg) `[h](none.md)`

                ```
                [i](none.md)
                ```

                # Here
                """);
        assertThat(brokenLinks(folder, page)).isEmpty();

        Files.writeString(page, """
                [a](B.java) [b](A.java#L3) [c](../other.md#no) [d](../other.md#twice-2) [e](#there) [f](../../x.md)
                <img src="no.svg">
                """);
        var broken = List.of(
                "B.java", "A.java#L3", "../other.md#no", "../other.md#twice-2", "#there", "../../x.md", "no.svg");
        assertThat(brokenLinks(folder, page))
                .isEqualTo(broken.stream().map("docs/page.md: "::concat).toList());
    }

    private static List<String> brokenLinks(Path root, Path page) throws IOException {
        List<String> broken = new ArrayList<>();
        for (String link : links(Files.readString(page))) {
            int hash = link.indexOf('#');
            String path = hash < 0 ? link : link.substring(0, hash);
            String anchor = hash < 0 ? "" : link.substring(hash + 1);
            Path target = path.isEmpty() ? page : page.resolveSibling(path).normalize();
            if (!target.startsWith(root) || !Files.exists(target) || !anchor.isEmpty() && !hasAnchor(target, anchor)) {
                broken.add(root.relativize(page).toString().replace('\\', '/') + ": " + link);
            }
        }
        return broken;
    }

    /** The links and pictures of a page that are no addresses, in order. */
    private static List<String> links(String markdown) {
        String prose = CODE.matcher(FENCE.matcher(markdown).replaceAll("")).replaceAll("");
        var links = LINK.matcher(prose).results();
        return links.map(match -> match.group(1) == null ? match.group(2) : match.group(1))
                .filter(link -> !ADDRESS.matcher(link).matches())
                .toList();
    }

    private static boolean hasAnchor(Path target, String anchor) throws IOException {
        if (target.toString().endsWith(".md")) {
            return anchors(Files.readString(target)).contains(anchor);
        }
        var lines = LINE.matcher(anchor);
        return lines.matches()
                && Integer.parseInt(lines.group(lines.group(2) == null ? 1 : 2))
                        <= Files.readAllLines(target).size();
    }

    /**
     * The anchors of the headings: letters, digits, hyphens and underscores in lower case; a number if not the first.
     */
    private static Set<String> anchors(String markdown) {
        Set<String> anchors = new HashSet<>();
        Map<String, Integer> count = new HashMap<>();
        HEADING.matcher(FENCE.matcher(markdown).replaceAll("")).results().forEach(match -> {
            String text =
                    match.group(1).replaceAll("\\[([^]]*)]\\([^)]*\\)", "$1").toLowerCase(Locale.ROOT);
            String anchor = text.replaceAll("[^\\p{L}\\p{N} _-]", "").replace(' ', '-');
            int earlier = count.merge(anchor, 1, Integer::sum) - 1;
            anchors.add(earlier == 0 ? anchor : anchor + "-" + earlier);
        });
        return anchors;
    }
}
