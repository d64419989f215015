package io.troupe.checks.docs;

import static java.util.stream.Collectors.toMap;
import static java.util.stream.Collectors.toSet;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import io.troupe.checks.docs.SamplesTest.Samples.Sample;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.regex.Pattern;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** The samples of the documentation occur in a source that the build compiles and whose tests it runs. */
class SamplesTest {
    @ParameterizedTest
    @ValueSource(
            strings = {
                "README.md",
                "docs/guide/01-actors.md",
                "docs/guide/02-the-papers-code.md",
                "docs/guide/03-proving-a-wiring.md",
                "docs/guide/04-bring-your-player-program.md",
                "docs/guide/06-subsumption.md",
                "docs/guide/07-actors-as-services.md",
                "docs/guide/08-bus-and-broker.md",
                "docs/guide/09-components.md",
                "docs/guide/13-over-hosts.md",
                "docs/guide/14-kotlin.md",
                "docs/guide/15-watching-robots.md",
                "docs/guide/16-recordings-in-other-tools.md",
                "docs/guide/17-a-world-as-a-library.md",
                "docs/guide/18-bip.md",
                "docs/guide/20-testing-actors.md",
                "actor-core/README.md",
                "actor-service/README.md",
                "actor-nats/README.md",
                "actor-kotlin/README.md",
                "actor-micrometer/README.md",
                "playerlike-sim/README.md",
                "services/README.md",
                "verification/README.md",
                "view/README.md"
            })
    void samples_occurInCompiledSources(String page) throws IOException {
        var samples = Samples.of(page, Repository.text(page));
        assertThat(samples).extracting(Sample::language).containsAnyOf("java", "kotlin");
        requireInSources(samples);
    }

    @Test
    void samplesInJavadoc_occurInCompiledSources() throws IOException {
        List<Sample> all = new ArrayList<>();
        for (Path source : Repository.javaSources()) {
            if (source.toString().contains("/src/main/")) {
                String text = Files.readString(source);
                var samples = Samples.ofJavadoc(source.getFileName().toString(), text);
                int snippets = text.split("\\* \\{@snippet ", -1).length;
                int others = text.split("\\* \\{@snippet lang = \"text\":", -1).length;
                assertThat(samples).as("Java samples of " + source).hasSize(snippets - others);
                all.addAll(samples);
            }
        }
        assertThat(all).hasSizeGreaterThan(20).noneMatch(sample -> sample.text().isBlank());
        requireInSources(all);
    }

    @Test
    void samplesInKdoc_occurInCompiledSources() throws IOException {
        List<Sample> all = new ArrayList<>();
        for (Path source : Repository.kotlinSources()) {
            if (source.toString().contains("/src/main/")) {
                all.addAll(Samples.ofKdoc(source.getFileName().toString(), Files.readString(source)));
            }
        }
        assertThat(all).hasSizeGreaterThan(5).noneMatch(sample -> sample.text().isBlank());
        requireInSources(all);
    }

    private static Map<String, String> essences = Map.of();

    /** Read once for all pages. */
    @BeforeAll
    static void readSources() throws IOException {
        essences = new TreeMap<>();
        for (Path source : Repository.javaSources()) {
            essences.put(source.toString(), Samples.essence(Files.readString(source)));
        }
        for (Path source : Repository.kotlinSources()) {
            essences.put(source.toString(), Samples.essence(Files.readString(source)));
        }
        for (String script : List.of("pom.xml", "build.gradle.kts")) { // how to depend on Troupe, of the README
            essences.put(script, Samples.essence(Repository.text("docs/examples/consumer/" + script)));
        }
    }

    private static void requireInSources(List<Sample> samples) {
        Map<String, Set<String>> missing = new TreeMap<>();
        samples.forEach(sample -> missing.put(sample.toString(), Samples.missing(sample, essences)));
        missing.values().removeIf(Set::isEmpty);
        assertThat(missing).as("samples of which no Java source has all pieces").isEmpty();
    }

    @Test
    void samplesInJavadoc_areFound_andAreNoSources() {
        var source = """
                /**
                 * Helps.
                 *
                 * {@snippet :
                 * void set(int x) {
                 *     this.x = x;
                 * }
                 *
                 * lamp.set(1);
                 * }
                 *
                 * {@snippet lang = "text":
                 * not Java
                 * }
                 */
                class Lamp {}
                """;
        var samples = Samples.ofJavadoc("Lamp.java", source);
        assertThat(samples).hasSize(1);
        assertThat(samples.getFirst().pieces())
                .containsExactly("void set(int x) {\n    this.x = x;\n}", "lamp.set(1);");
        assertThat(Samples.missing(samples.getFirst(), Map.of("Lamp.java", Samples.essence(source))))
                .hasSize(2);
    }

    @Test
    void sample_isFoundAsTheFormatterWritesIt_andByItsPieces() {
        var sample = sample("void set(int x) { this.x = x; }  // one\n\nlamp.set(1);\n");
        var formatted = "@Override public void set(int x) {\n    this.x = x; // why\n}\n lamp\n    .set(1);";
        assertThat(Samples.missing(sample, Map.of("A", Samples.essence(formatted))))
                .isEmpty();
    }

    @Test
    void sample_thatDiffersOrIsSpreadOverTwoSources_isMissing() {
        var sample = sample("lamp.set(1);\n\nlamp.on();\n");
        assertThat(Samples.missing(sample, Map.of("A", "lamp.set(2);lamp.on();")))
                .containsExactly("lamp.set(1);");
        assertThat(Samples.missing(sample, Map.of("A", "lamp.set(1);", "B", "lamp.on();")))
                .hasSize(1);
        assertThat(Samples.missing(sample, Map.of())).hasSize(2);
    }

    @Test
    void essence_keepsWordsApart_andAddresses() {
        assertThat(Samples.essence("int  a = b ;\n// no\n")).isEqualTo("int a=b;");
        assertThat(Samples.essence("get(\"http://x\")")).isEqualTo("get(\"http://x\")");
    }

    private static Sample sample(String java) {
        return Samples.of("page.md", "# Title\n\n```java\n" + java + "```\n").getFirst();
    }

    @Test
    void sources_areThoseOfAllModules() {
        assertThat(Repository.javaSources())
                .extracting(source -> source.getFileName().toString())
                .contains("ActorSpace.java", "ActorsGuideTest.java", "Main.java");
    }

    /**
     * The samples of a Markdown page or of Javadoc, and their comparison with sources.
     *
     * <p><b>Role.</b> A sample is split at empty lines, and each piece must occur in one and the same source. The
     * comparison ignores what the formatter decides and what no compiler reads: white space, {@code //} comments,
     * {@code @Override} and Kotlin's {@code override}.
     */
    static final class Samples {
        private static final Pattern FENCE = Pattern.compile("(?ms)^```(\\w*)\\n(.*?)^```$");
        private static final Pattern COMMENT = Pattern.compile("(?m)(?<![:\"])//.*$");
        private static final Pattern JAVADOC = Pattern.compile("(?ms)^ */\\*\\*.*?\\*/");
        private static final Pattern SNIPPET = Pattern.compile("(?m)^ *\\* \\{@snippet :\\n");
        private static final Pattern STAR = Pattern.compile("(?m)^ *\\* ?");
        private static final Pattern SPACE = Pattern.compile("\\s+");
        private static final Pattern SPACE_BESIDE_A_SIGN = Pattern.compile(" (?=\\W)|(?<=\\W) ");

        private Samples() {}

        /** A fenced block. */
        record Sample(String page, int line, String language, String text) {
            List<String> pieces() {
                return language.equals("java") || language.equals("kotlin")
                        ? List.of(text.strip().split("\\n\\s*\\n"))
                        : text.strip().lines().toList();
            }

            @Override
            public String toString() {
                return page + ":" + line;
            }
        }

        static List<Sample> of(String page, String markdown) {
            List<Sample> samples = new ArrayList<>();
            var fences = FENCE.matcher(markdown);
            while (fences.find()) {
                int line = (int) markdown.substring(0, fences.start()).lines().count() + 1;
                samples.add(new Sample(page, line, fences.group(1), fences.group(2)));
            }
            return samples;
        }

        /** The samples in the KDoc of a Kotlin source: its fenced blocks. */
        static List<Sample> ofKdoc(String source, String kotlin) {
            List<Sample> samples = new ArrayList<>();
            var comments = JAVADOC.matcher(kotlin);
            while (comments.find()) {
                int line = (int) kotlin.substring(0, comments.start()).lines().count() + 1;
                String text = STAR.matcher(comments.group()).replaceAll("");
                var fences = FENCE.matcher(text);
                while (fences.find()) {
                    samples.add(new Sample(source, line, "kotlin", fences.group(2)));
                }
            }
            return samples;
        }

        /** The Java samples in the Javadoc of a source: its inline {@code @snippet} tags, as they are printed. */
        static List<Sample> ofJavadoc(String source, String java) {
            List<Sample> samples = new ArrayList<>();
            var snippets = SNIPPET.matcher(java);
            while (snippets.find()) {
                int line = (int) java.substring(0, snippets.start()).lines().count() + 1;
                String code = java.substring(snippets.end(), endOfSnippet(java, snippets.end()));
                samples.add(new Sample(source, line, "java", STAR.matcher(code).replaceAll("")));
            }
            return samples;
        }

        /** The index of the brace that closes an inline tag, whose content has balanced braces. */
        private static int endOfSnippet(String java, int start) {
            int end = start;
            for (int depth = 1; depth > 0; end++) {
                depth += java.charAt(end) == '{' ? 1 : java.charAt(end) == '}' ? -1 : 0;
            }
            return end - 1;
        }

        /** The text without what the comparison ignores. */
        static String essence(String java) {
            String code = COMMENT.matcher(JAVADOC.matcher(java).replaceAll(""))
                    .replaceAll("")
                    .replaceAll("@Override|\\boverride ", "");
            String spaced = SPACE.matcher(code).replaceAll(" ").strip();
            return SPACE_BESIDE_A_SIGN.matcher(spaced).replaceAll("");
        }

        /**
         * The errors of a sample: empty if one of the sources contains it.
         *
         * @param sources essences by path
         */
        static Set<String> missing(Sample sample, Map<String, String> sources) {
            Map<String, String> pieces =
                    sample.pieces().stream().distinct().collect(toMap(piece -> piece, Samples::essence));
            return sources.values().stream()
                    .map(source -> pieces.keySet().stream()
                            .filter(piece -> !source.contains(pieces.get(piece)))
                            .collect(toSet()))
                    .min(Comparator.comparingInt(Set::size))
                    .orElse(Set.copyOf(sample.pieces()));
        }
    }
}
