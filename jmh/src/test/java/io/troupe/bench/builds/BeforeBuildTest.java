package io.troupe.bench.builds;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatCode;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

import java.io.File;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.FileTime;
import java.util.EnumSet;
import java.util.List;
import java.util.jar.JarEntry;
import java.util.jar.JarOutputStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class BeforeBuildTest {
    private static final BeforeBuild.Module ACTORS = BeforeBuild.Module.ACTOR_CORE;
    private static final BeforeBuild.Module WORLDS = BeforeBuild.Module.PLAYERLIKE_SIM;

    @TempDir
    Path folder;

    private Path jar(String name, BeforeBuild.Module... modules) throws IOException {
        Path jar = folder.resolve(name);
        Files.createDirectories(jar.getParent());
        try (var out = new JarOutputStream(Files.newOutputStream(jar))) {
            for (BeforeBuild.Module each : modules) {
                out.putNextEntry(new JarEntry(each.marker()));
                out.closeEntry();
            }
        }
        return jar;
    }

    private Path classes(String name, BeforeBuild.Module module, int second) throws IOException {
        Path marker = folder.resolve(name).resolve(module.marker());
        Files.createDirectories(marker.getParent());
        Files.createFile(marker);
        Files.setLastModifiedTime(marker, FileTime.fromMillis(1_000L * second));
        return folder.resolve(name);
    }

    @Test
    void repository_hasTheJarsOfItsModules_withoutSourcesAndOtherJars() throws Exception {
        Path actors = jar("io/troupe/troupe-actor-core/1/troupe-actor-core-1.jar", ACTORS);
        jar("io/troupe/troupe-actor-core/1/troupe-actor-core-1-sources.jar", ACTORS);
        jar("io/troupe/troupe-jmh/1/troupe-jmh-1.jar");
        Path worlds = jar("io/troupe/troupe-playerlike-sim/1/troupe-playerlike-sim-1.jar", WORLDS);
        jar("org/other/1/other-1.jar", ACTORS);
        for (String root : List.of("", "io/troupe")) {
            assertThat(BeforeBuild.at(List.of(folder.resolve(root))).entries()).containsExactly(actors, worlds);
        }
    }

    @Test
    void twoVersionsOfAModule_areRefused_byTheirNames() throws Exception {
        jar("lib/troupe-actor-core-1.jar", ACTORS);
        jar("lib/troupe-actor-core-2.jar", ACTORS);
        assertThatIllegalArgumentException()
                .isThrownBy(() -> BeforeBuild.at(List.of(folder.resolve("lib"))))
                .withMessageContaining("has actor-core twice: ")
                .withMessageContaining("troupe-actor-core-1.jar and ")
                .withMessageContaining("expected it once");
    }

    @Test
    void checkout_hasTheClassesThatWereBuiltLast_byMavenOrGradle() throws Exception {
        Path maven = classes("actor-core/target/classes", ACTORS, 2);
        classes("actor-core/build/classes/java/main", ACTORS, 1);
        classes("playerlike-sim/target/classes", WORLDS, 1);
        Path gradle = classes("playerlike-sim/build/classes/java/main", WORLDS, 2);
        Path resources = Files.createDirectories(folder.resolve("playerlike-sim/build/resources/main"));
        assertThat(BeforeBuild.at(List.of(folder)).entries()).containsExactly(maven, gradle, resources);
        assertThat(BeforeBuild.at(List.of(folder.resolve("actor-core"))).entries())
                .containsExactly(maven);
    }

    @Test
    void severalPaths_areTakenInTheirOrder_aJarAndAFolderOfClassesAsTheyAre() throws Exception {
        Path worlds = classes("some/classes", WORLDS, 1);
        Path actors = jar("any.jar", ACTORS);
        var build = BeforeBuild.at(List.of(worlds, actors));
        assertThat(build.entries()).containsExactly(worlds, actors);
        assertThat(build.classPath("measuring", "now").split(File.pathSeparator))
                .containsExactly("measuring", worlds.toString(), actors.toString(), "now");
        assertThatCode(() -> build.require(BuildPart.SIMULATOR, EnumSet.of(WORLDS, ACTORS)))
                .doesNotThrowAnyException();
    }

    @Test
    void missingModule_isNamed_withWhatWasExpected() throws Exception {
        var build = BeforeBuild.at(List.of(jar("lib/troupe-actor-core-1.jar", ACTORS)));
        assertThatIllegalArgumentException()
                .isThrownBy(() -> build.require(BuildPart.NETS, EnumSet.of(BeforeBuild.Module.VERIFICATION)))
                .withMessageContaining("--before has no verification, which the part nets measures: expected"
                        + " troupe-verification-VERSION.jar or classes with io/troupe/petri/PetriNet.class in ")
                .withMessageContaining("troupe-actor-core-1.jar; or choose other parts");
    }

    @Test
    void path_withoutABuild_isRefused_byItsName() {
        for (Path path : List.of(folder, folder.resolve("missing"))) {
            assertThatIllegalArgumentException()
                    .isThrownBy(() -> BeforeBuild.at(List.of(path)))
                    .withMessageContaining("--before is " + path + ", which has no build of Troupe; expected a jar");
        }
    }
}
