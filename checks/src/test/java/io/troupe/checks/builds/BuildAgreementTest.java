package io.troupe.checks.builds;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import io.troupe.checks.builds.Build.Dependency;
import io.troupe.checks.builds.Build.Module;
import io.troupe.checks.builds.Build.Scope;
import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import org.junit.jupiter.api.Test;

/** The Gradle and the Maven build of this repository agree. */
class BuildAgreementTest {
    private static final Dependency ASM = new Dependency(Scope.COMPILE, "org.ow2.asm:asm", "9.9");
    private static final Module SAMPLE = module(ASM);

    @Test
    void gradleAndMaven_agree_onAllModules() throws IOException {
        var gradle = GradleReader.read(Repository.root());
        var maven = PomReader.read(Repository.root());
        var folders = Repository.modules().stream().map(Path::getFileName).map(Path::toString);
        assertThat(gradle.differencesTo(maven))
                .as("differences between the two builds")
                .isEmpty();
        assertThat(gradle.modules().keySet()).containsExactlyInAnyOrderElementsOf(folders.toList());
        assertThat(GradleReader.unusedLibraries(Repository.root()))
                .as("libraries in libs.versions.toml that no script uses")
                .isEmpty();
    }

    @Test
    void difference_inADependencyOrReleaseLevel_isNamed() {
        assertDifference(
                module(new Dependency(Scope.COMPILE, "org.ow2.asm:asm", "9.8")),
                "core: dependency is \"compile org.ow2.asm:asm:9.9\" in Gradle, \"compile org.ow2.asm:asm:9.8\" in Maven");
        assertDifference(
                module(new Dependency(Scope.TEST, "org.ow2.asm:asm", "9.9")),
                "core: dependency is \"compile org.ow2.asm:asm:9.9\" in Gradle, \"test org.ow2.asm:asm:9.9\" in Maven");
        assertDifference(
                module(ASM.excluding(List.of("a:b"))),
                "core: dependency is \"compile org.ow2.asm:asm:9.9\" in Gradle, "
                        + "\"compile org.ow2.asm:asm:9.9 without [a:b]\" in Maven");
        assertDifference(module(), "core: only Gradle has compile org.ow2.asm:asm:9.9");
        assertDifference(
                new Module("Actors", "17", "a", List.of(ASM)),
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
        var other = new Build("Maven", "g", "1", Map.of("core", maven));
        assertThat(gradle.differencesTo(other)).containsExactly(message);
    }

    private static Module module(Dependency... dependencies) {
        return new Module("Actors", "21", "a", List.of(dependencies));
    }
}
