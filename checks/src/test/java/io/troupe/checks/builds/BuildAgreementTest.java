package io.troupe.checks.builds;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import org.junit.jupiter.api.Test;

/** The Gradle and the Maven build of this repository agree. */
class BuildAgreementTest {
    private static final Module SAMPLE = module(new Dependency(Scope.COMPILE, "org.ow2.asm:asm", "9.9"));

    @Test
    void gradleAndMaven_agree() throws IOException {
        var gradle = GradleReader.read(Repository.root());
        var maven = PomReader.read(Repository.root());
        assertThat(gradle.differencesTo(maven))
                .as("differences between the two builds")
                .isEmpty();
    }

    @Test
    void modules_areAllInBothBuilds() throws IOException {
        var folders = Repository.modules().stream().map(Path::getFileName).map(Path::toString);
        assertThat(GradleReader.read(Repository.root()).modules().keySet())
                .containsExactlyInAnyOrderElementsOf(folders.toList());
    }

    @Test
    void catalog_namesNoLibraryThatNobodyUses() throws IOException {
        assertThat(GradleReader.unusedLibraries(Repository.root()))
                .as("libraries in libs.versions.toml that no script uses")
                .isEmpty();
    }

    @Test
    void difference_inAVersion_isNamed() {
        assertDifference(
                module(new Dependency(Scope.COMPILE, "org.ow2.asm:asm", "9.8")),
                "core: dependency is \"compile org.ow2.asm:asm:9.9\" in Gradle, \"compile org.ow2.asm:asm:9.8\" in Maven");
    }

    @Test
    void difference_inAScope_isNamed() {
        assertDifference(
                module(new Dependency(Scope.TEST, "org.ow2.asm:asm", "9.9")),
                "core: dependency is \"compile org.ow2.asm:asm:9.9\" in Gradle, \"test org.ow2.asm:asm:9.9\" in Maven");
    }

    @Test
    void difference_inWhatIsLeftOut_isNamed() {
        var asm = SAMPLE.dependencies().getFirst();
        assertDifference(
                module(asm.excluding(List.of("a:b"))),
                "core: dependency is \"compile org.ow2.asm:asm:9.9\" in Gradle, "
                        + "\"compile org.ow2.asm:asm:9.9 without [a:b]\" in Maven");
    }

    @Test
    void dependency_inOneBuildOnly_isNamed() {
        assertDifference(module(), "core: only Gradle has compile org.ow2.asm:asm:9.9");
    }

    @Test
    void difference_inTheReleaseLevel_isNamed() {
        assertDifference(
                new Module("Actors", "17", "a", SAMPLE.dependencies()),
                "core: release level is \"21\" in Gradle, \"17\" in Maven");
    }

    @Test
    void module_inOneBuildOnly_isNamed() {
        var gradle = new Build("Gradle", "g", "1", Map.of("core", SAMPLE));
        var maven = new Build("Maven", "g", "2", Map.of());
        assertThat(gradle.differencesTo(maven))
                .containsExactly("version is \"1\" in Gradle, \"2\" in Maven", "module core: only in Gradle");
    }

    private static void assertDifference(Module maven, String message) {
        var gradle = new Build("Gradle", "g", "1", Map.of("core", SAMPLE));
        assertThat(gradle.differencesTo(new Build("Maven", "g", "1", Map.of("core", maven))))
                .containsExactly(message);
    }

    private static Module module(Dependency... dependencies) {
        return new Module("Actors", "21", "a", List.of(dependencies));
    }
}
