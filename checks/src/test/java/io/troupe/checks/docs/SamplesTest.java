package io.troupe.checks.docs;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import io.troupe.checks.api.PublicTypes;
import io.troupe.checks.docs.Samples.Sample;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
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
                "docs/guide/03-proving-a-wiring.md",
                "docs/guide/04-bring-your-player-program.md",
                "docs/guide/06-subsumption.md",
                "docs/guide/07-actors-as-services.md",
                "docs/guide/08-bus-and-broker.md",
                "docs/guide/09-components.md",
                "actor-core/README.md",
                "actor-service/README.md",
                "playerlike-sim/README.md",
                "services/README.md",
                "verification/README.md",
                "view/README.md"
            })
    void samples_occurInCompiledSources(String page) throws IOException {
        var samples = Samples.of(page, Repository.text(page));
        assertThat(samples).extracting(Sample::language).contains("java");
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

    private static void requireInSources(List<Sample> samples) throws IOException {
        Map<String, String> essences = new TreeMap<>();
        for (Path source : Repository.javaSources()) {
            essences.put(source.toString(), Samples.essence(Files.readString(source)));
        }
        for (String script : List.of("pom.xml", "build.gradle.kts")) { // how to depend on Troupe, of the README
            essences.put(script, Samples.essence(Repository.text("docs/examples/consumer/" + script)));
        }
        Map<String, Set<String>> missing = new TreeMap<>();
        samples.forEach(sample -> missing.put(sample.toString(), Samples.missing(sample, essences)));
        missing.values().removeIf(Set::isEmpty);
        assertThat(missing).as("samples of which no Java source has all pieces").isEmpty();
    }

    @ParameterizedTest
    @ValueSource(strings = {"actor-core", "actor-service"})
    void types_haveASample_orSayHowUsersMeetThem(String module) throws IOException {
        Path folder = Repository.root().resolve(module).resolve("src/main/java");
        assertThat(PublicTypes.in(folder))
                .filteredOn(type -> !type.isForTheLibraryOnly())
                .hasSizeGreaterThan(20)
                .allSatisfy(type ->
                        assertThat(type.javadoc()).as(type.name()).containsAnyOf("{@snippet", "Users meet it as "));
    }

    /** The client and its interfaces that work; the package documentation gives the reason for the others. */
    @Test
    void workingTypesOfThePlayerClient_haveASample() throws IOException {
        var types = PublicTypes.in(Repository.root().resolve("playerlike-sim/src/main/java/io/troupe/player"));
        for (String working :
                List.of("PlayerClient", "Position2D", "Sonar", "Laser", "Blobfinder", "Ranger", "Simulation")) {
            String name = "io.troupe.player." + (working.equals("PlayerClient") ? working : working + "Interface");
            assertThat(types)
                    .filteredOn(type -> type.name().equals(name))
                    .singleElement()
                    .satisfies(type -> assertThat(type.javadoc()).as(name).contains("{@snippet"));
        }
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
}
