package io.troupe.checks.builds;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class GradleReaderTest {
    private static final String ROOT_SCRIPT = """
            val a = setOf("core") // a remark with a { brace
            subprojects {
                val libs = rootProject.extensions.getByType<VersionCatalogsExtension>().named("libs")
                dependencies {
                    "testImplementation"(libs.findLibrary("junit").get())
                    "testRuntimeOnly"(libs.findLibrary("launcher").get())
                }
                tasks.withType<JavaCompile>().configureEach {
                    options.release.set(21)
                    options.encoding = "UTF-8"
                }
            }
            """;
    private static final String MODULE_SCRIPT = """
            plugins { application }
            description = "Actors"
            dependencies {
                api(libs.my.asm)
                implementation(project(":core"))
                annotationProcessor(libs.my.asm)
            }
            application { mainClass.set("Main") }
            tasks.jar { manifest { attributes("Automatic-Module-Name" to "a.b") } }
            """;

    @TempDir
    Path root;

    @BeforeEach
    void writeBuild() throws IOException {
        write("gradle.properties", "group=g\nversion=1\n");
        write("settings.gradle.kts", "rootProject.name = \"troupe\"\ninclude(\"core\")\n");
        write("build.gradle.kts", ROOT_SCRIPT);
        write("core/build.gradle.kts", MODULE_SCRIPT);
        write("gradle/libs.versions.toml", """
                [versions]
                asm = "9.9"
                junit = "5"
                [libraries]
                my-asm = { module = "org.ow2.asm:asm", version.ref = "asm" }
                junit = { module = "org.junit:junit", version.ref = "junit" }
                launcher = { module = "org.junit.platform:junit-platform-launcher", version.ref = "junit" }
                """);
    }

    @Test
    void build_isReadWhole() throws IOException {
        var build = GradleReader.read(root);
        assertThat(build.group()).isEqualTo("g");
        assertThat(build.modules()).containsOnlyKeys("core");
        var module = build.modules().get("core");
        assertThat(module)
                .extracting(Module::description, Module::release, Module::automaticName)
                .containsExactly("Actors", "21", "a.b");
        assertThat(module.dependencies())
                .containsExactly(
                        new Dependency(Scope.TEST, "org.junit:junit", "5"),
                        new Dependency(Scope.COMPILE, "org.ow2.asm:asm", "9.9"),
                        new Dependency(Scope.COMPILE, "g:troupe-core", "1"),
                        new Dependency(Scope.PROCESSOR, "org.ow2.asm:asm", "9.9"));
    }

    @Test
    void implementation_ofAPublishedModule_isRuntimeForItsUsers() throws IOException {
        write("build.gradle.kts", ROOT_SCRIPT.replace("val a =", "val published ="));
        assertThat(GradleReader.read(root).modules().get("core").dependencies())
                .contains(
                        new Dependency(Scope.COMPILE, "org.ow2.asm:asm", "9.9"),
                        new Dependency(Scope.RUNTIME, "g:troupe-core", "1"));
    }

    @Test
    void exclusions_areRead() throws IOException {
        write("core/build.gradle.kts", """
                dependencies {
                    api(libs.my.asm) { // why
                        exclude(group = "c", module = "d.e")
                        exclude(group = "a", module = "b")
                    }
                }
                """);
        var module = GradleReader.read(root).modules().get("core");
        assertThat(module.dependencies().getLast()).hasToString("compile org.ow2.asm:asm:9.9 without [a:b, c:d.e]");
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '\'',
            value = {
                "implementation(\"a:b:1\")          | core/build.gradle.kts: not understood: implementation(\"a:b:1\")",
                "api(libs.my.asm) { a = 1 }         | core/build.gradle.kts: not understood: a = 1",
                "api(libs.my.asm) { exclude(\"a\") } | core/build.gradle.kts: not understood: exclude(\"a\")",
                "api(project(\":core\")) { a = 1 }   | core/build.gradle.kts: not understood: api(project(\":core\")) {..}",
                "implementation(libs.asm).a()       | core/build.gradle.kts: not understood: implementation(libs.asm).a()",
                "implementation(libs.gone)          | libs.versions.toml: no library gone; there are",
                "kapt(libs.my.asm)                  | configuration kapt is not understood",
                "if (a) { api(libs.my.asm) }        | core/build.gradle.kts: not understood: if (a) {..}"
            })
    void dependencyLine_ofAnotherForm_isRefused(String line, String message) throws IOException {
        write("core/build.gradle.kts", "dependencies {\n" + line + "\n}\n");
        assertRefused(message);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '\'',
            value = {
                "plugins { kotlin }                                  | core/build.gradle.kts: not understood: plugins {..}",
                "configurations.all { }                              | core/build.gradle.kts: not understood: configurations.all {..}",
                "apply(from = \"x.kts\")                             | core/build.gradle.kts: not understood: apply(from = \"x.kts\")",
                "tasks.compileJava { options.release.set(17) }       | core/build.gradle.kts: \"release\" is not understood in: tasks.compileJava",
                "tasks.x { project.dependencies.add(\"api\", \"a\") } | core/build.gradle.kts: \"dependencies\" is not understood in: tasks.x",
                "tasks.x { a = \"                                    | a string is not closed",
                "tasks.x { (                                         | core/build.gradle.kts: a bracket is not closed",
                "}                                                   | core/build.gradle.kts: a } that nothing opened"
            })
    void statement_ofAnotherForm_isRefused(String statement, String message) throws IOException {
        write("core/build.gradle.kts", statement + "\n");
        assertRefused(message);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '\'',
            value = {
                "includeBuild(\"x\")                | settings.gradle.kts: not understood: includeBuild(\"x\")",
                "project(\":core\").name = \"other\" | settings.gradle.kts: not understood: project(\":core\").name",
                "dependencyResolutionManagement { repositories { maven { url = \"x\" } } } | settings.gradle.kts: expected"
            })
    void settings_ofAnotherForm_areRefused(String statement, String message) throws IOException {
        write("settings.gradle.kts", statement + "\n");
        assertRefused(message);
    }

    @Test
    void rootScript_withoutAReleaseLevel_isRefused() throws IOException {
        write("build.gradle.kts", ROOT_SCRIPT.replace("options.release.set(21)", ""));
        assertRefused("build.gradle.kts: no options.release.set(..) for JavaCompile");
    }

    @Test
    void rootScript_withAnotherDependencyForm_isRefused() throws IOException {
        write("build.gradle.kts", ROOT_SCRIPT.replace("libs.findLibrary(\"junit\").get()", "\"a:b:1\""));
        assertRefused("build.gradle.kts: not understood: \"testImplementation\"(\"a:b:1\")");
    }

    @Test
    void libraryNobodyUses_isFound() throws IOException {
        assertThat(GradleReader.unusedLibraries(root)).isEmpty();
        write("core/build.gradle.kts", "description = \"nothing\"\n");
        assertThat(GradleReader.unusedLibraries(root)).containsExactly("my.asm");
    }

    @Test
    void version_thatIsStrict_isReadWithoutItsMark() {
        var catalog = new VersionCatalog("""
                [versions]
                fst = "2.57!!"
                [libraries]
                fst = { module = "a:fst", version.ref = "fst" }
                """);
        assertThat(catalog.library(Scope.COMPILE, "fst")).isEqualTo(new Dependency(Scope.COMPILE, "a:fst", "2.57"));
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '\'',
            value = {
                "[plugins] | a = \"1\"                                      | section [plugins] is not understood",
                "[libraries] | a = { group = \"g\", name = \"n\" }          | expected alias = { module",
                "[libraries] | a = { module = \"g:n\", version.ref = \"v\" } | no version named v",
                "[versions] | a = { strictly = \"1\" }                      | not understood, or given twice"
            })
    void catalog_ofAnotherForm_isRefused(String section, String line, String message) {
        assertThatThrownBy(() -> new VersionCatalog(section + "\n" + line))
                .isInstanceOf(BuildFileException.class)
                .hasMessageContaining(message);
    }

    private void assertRefused(String message) {
        assertThatThrownBy(() -> GradleReader.read(root))
                .isInstanceOf(BuildFileException.class)
                .hasMessageContaining(message);
    }

    private void write(String file, String text) throws IOException {
        var path = root.resolve(file);
        Files.createDirectories(path.getParent());
        Files.writeString(path, text);
    }
}
