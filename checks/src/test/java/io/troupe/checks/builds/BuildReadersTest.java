package io.troupe.checks.builds;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.checks.builds.Build.Dependency;
import io.troupe.checks.builds.Build.Module;
import io.troupe.checks.builds.Build.NotUnderstood;
import io.troupe.checks.builds.Build.Scope;
import io.troupe.checks.builds.GradleReader.VersionCatalog;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.TreeSet;
import org.assertj.core.api.ThrowableAssert.ThrowingCallable;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** {@link GradleReader} and {@link PomReader}. */
class BuildReadersTest {
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
    private static final String ROOT_POM = """
            <project>
              <groupId>g</groupId><artifactId>root</artifactId><version>1</version>
              <properties><maven.compiler.release>21</maven.compiler.release><asm.version>9.9</asm.version></properties>
              <dependencies><dependency>
                <groupId>t</groupId><artifactId>junit</artifactId><version>5</version><scope>test</scope>
              </dependency></dependencies>
            </project>
            """;
    private static final String POM_HEAD = "<artifactId>troupe-core</artifactId>"
            + "<parent><groupId>g</groupId><artifactId>root</artifactId><version>1</version></parent>";

    @TempDir
    Path root;

    private static void assertRefused(ThrowingCallable reading, String message) {
        assertThatThrownBy(reading).isInstanceOf(NotUnderstood.class).hasMessageContaining(message);
    }

    // ---- Gradle

    @BeforeEach
    void writeBuild() throws IOException {
        write("gradle.properties", "group=g\nversion=1\n");
        write("settings.gradle.kts", "rootProject.name = \"troupe\"\ninclude(\"core\")\n");
        write("build.gradle.kts", ROOT_SCRIPT);
        write("core/build.gradle.kts", """
                plugins { application }
                description = "Actors"
                dependencies {
                    api(libs.my.asm)
                    implementation(project(":core"))
                    annotationProcessor(libs.my.asm)
                }
                application { mainClass.set("Main") }
                tasks.jar { manifest { attributes("Automatic-Module-Name" to "a.b") } }
                """);
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

    private void write(String file, String text) throws IOException {
        var path = root.resolve(file);
        Files.createDirectories(path.getParent());
        Files.writeString(path, text);
    }

    @Test
    void gradleBuild_isReadWhole() throws IOException {
        var build = GradleReader.read(root);
        assertThat(build.group()).isEqualTo("g");
        assertThat(build.modules()).containsOnlyKeys("core");
        assertThat(build.modules().get("core"))
                .isEqualTo(new Module(
                        "Actors",
                        "21",
                        "a.b",
                        new TreeSet<>(),
                        new TreeMap<>(Map.of("run", "Main")),
                        List.of(
                                new Dependency(Scope.TEST, "org.junit:junit", "5"),
                                new Dependency(Scope.COMPILE, "org.ow2.asm:asm", "9.9"),
                                new Dependency(Scope.COMPILE, "g:troupe-core", "1"),
                                new Dependency(Scope.PROCESSOR, "org.ow2.asm:asm", "9.9"))));
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
    void kotlinOptions_ofBothBuilds_areReadInTheSameWords() throws IOException {
        write("gradle/libs.versions.toml", """
                [versions]
                junit = "5"
                kotlin = "2.4.21"
                [libraries]
                junit = { module = "org.junit:junit", version.ref = "junit" }
                launcher = { module = "org.junit.platform:junit-platform-launcher", version.ref = "junit" }
                [plugins]
                kotlin-jvm = { id = "org.jetbrains.kotlin.jvm", version.ref = "kotlin" }
                """);
        write("core/build.gradle.kts", """
                plugins { alias(libs.plugins.kotlin.jvm) }
                kotlin {
                    explicitApi()
                    compilerOptions {
                        jvmTarget.set(org.jetbrains.kotlin.gradle.dsl.JvmTarget.JVM_21)
                        allWarningsAsErrors.set(true)
                        javaParameters.set(true)
                        freeCompilerArgs.add("-Xjsr305=strict")
                    }
                }
                """);
        var plugin = "<artifactId>kotlin-maven-plugin</artifactId>";
        var rootPom = ROOT_POM.replace(
                "</project>",
                "<build><pluginManagement><plugins><plugin>" + plugin
                        + "<version>2.4.21</version></plugin></plugins></pluginManagement></build></project>");
        var both = "<arg>-Werror</arg><arg>-java-parameters</arg><arg>-Xjsr305=strict</arg>";
        var pom = "<project>" + POM_HEAD + "<build><plugins><plugin>" + plugin + """
                <configuration><jvmTarget>${maven.compiler.release}</jvmTarget></configuration>
                <executions>
                  <execution><goals><goal>compile</goal></goals>
                    <configuration><args>%s<arg>-Xexplicit-api=strict</arg></args></configuration></execution>
                  <execution><goals><goal>test-compile</goal></goals>
                    <configuration><args>%s</args></configuration></execution>
                </executions>
                </plugin></plugins></build></project>
                """.formatted(both, both);
        var maven = PomReader.module(rootPom, "core", pom).kotlin();
        assertThat(maven)
                .containsExactlyInAnyOrder(
                        "compiler 2.4.21",
                        "-jvm-target 21",
                        "-Werror",
                        "-java-parameters",
                        "-Xjsr305=strict",
                        "main -Xexplicit-api=strict");
        assertThat(GradleReader.read(root).modules().get("core").kotlin()).isEqualTo(maven);
    }

    @Test
    void programs_ofBothBuilds_areReadInTheSameWords() throws IOException {
        write("core/build.gradle.kts", """
                tasks.register<JavaExec>("nets") {
                    mainClass.set("a.Nets")
                    jvmArgs("-Xmx1g")
                }
                """);
        var execution = """
                <build><plugins><plugin><artifactId>exec-maven-plugin</artifactId>
                <executions><execution><id>nets</id><configuration>%s
                  <commandlineArgs>-Xmx1g -classpath %%classpath a.Nets ${args}</commandlineArgs>
                </configuration></execution></executions>
                </plugin></plugins></build>
                """;
        var nets = Map.of("nets", "-Xmx1g a.Nets");
        assertThat(GradleReader.read(root).modules().get("core").programs()).isEqualTo(nets);
        assertThat(read(execution.formatted("<skip>false</skip>")).programs()).isEqualTo(nets);
        assertRefused(
                () -> read(execution.formatted("")), "core/pom.xml: nets is skipped by default, expected <skip>false");
        assertRefused(
                () -> read(execution.formatted("<skip>false</skip>").replace("-classpath", "-cp")),
                "core/pom.xml: in nets expected OPTIONS -classpath %classpath MAIN ${..}");
    }

    @Test
    void exclusions_ofGradle_areRead() throws IOException {
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

    @Test
    void testsOfAModule_areADependency_inBothBuilds() throws IOException {
        write("core/build.gradle.kts", """
                configurations.create("tests") { isCanBeResolved = false }
                artifacts {
                    add("tests", tasks.register<Jar>("testsJar") {
                        archiveClassifier.set("tests")
                        from(sourceSets.test.get().output)
                    })
                }
                dependencies { testImplementation(project(path = ":core", configuration = "tests")) }
                """);
        var tests = new Dependency(Scope.TEST, "g:troupe-core:tests", "1");
        assertThat(GradleReader.read(root).modules().get("core").dependencies()).endsWith(tests);
        assertThat(read("<dependencies><dependency><groupId>g</groupId><artifactId>troupe-core</artifactId>"
                                + "<version>1</version><type>test-jar</type><scope>test</scope>"
                                + "</dependency></dependencies>")
                        .dependencies())
                .endsWith(tests);
    }

    /** A line without a file belongs to the dependencies of {@code core}. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            | implementation("a:b:1")          | core/build.gradle.kts: not understood: implementation("a:b:1")
            | api(libs.my.asm) { a = 1 }       | core/build.gradle.kts: not understood: a = 1
            | api(libs.my.asm) { exclude("a") } | core/build.gradle.kts: not understood: exclude("a")
            | api(project(":core")) { a = 1 }  | core/build.gradle.kts: not understood: api(project(":core")) {..}
            | implementation(libs.asm).a()     | core/build.gradle.kts: not understood: implementation(libs.asm).a()
            | implementation(libs.gone)        | libs.versions.toml: no library gone; there are
            | kapt(libs.my.asm)                | configuration kapt is not understood
            | if (a) { api(libs.my.asm) }      | core/build.gradle.kts: not understood: if (a) {..}
            core/build.gradle.kts | kotlin { jvmToolchain(8) } | core/build.gradle.kts: not understood: jvmToolchain(8)
            core/build.gradle.kts | kotlin { compilerOptions { progressiveMode.set(true) } } | \
            core/build.gradle.kts: not understood: progressiveMode.set(true)
            core/build.gradle.kts | configurations.testImplementation { a } | \
            core/build.gradle.kts: not understood: configurations.testImplementation {..}
            settings.gradle.kts | pluginManagement { repositories { gradlePluginPortal() } } | \
            settings.gradle.kts: plugins are expected from Maven Central alone
            core/build.gradle.kts | plugins { kotlin }         | core/build.gradle.kts: not understood: plugins {..}
            core/build.gradle.kts | configurations.all { } | \
            core/build.gradle.kts: not understood: configurations.all {..}
            core/build.gradle.kts | artifacts { add("tests", x) } | \
            core/build.gradle.kts: artifacts is not understood, expected the jar of the tests
            core/build.gradle.kts | apply(from = "x.kts") | core/build.gradle.kts: not understood: apply(from = "x.kts")
            core/build.gradle.kts | tasks.compileJava { options.release.set(17) } | \
            core/build.gradle.kts: "release" is not understood in: tasks.compileJava
            core/build.gradle.kts | tasks.x { project.dependencies.add("api", "a") } | \
            core/build.gradle.kts: "dependencies" is not understood in: tasks.x
            core/build.gradle.kts | tasks.register<JavaExec>("x") { } | \
            core/build.gradle.kts: no mainClass.set("..") in: tasks.register<JavaExec>("x")
            core/build.gradle.kts | tasks.x { a = "            | a string is not closed
            core/build.gradle.kts | tasks.x { (                | core/build.gradle.kts: a bracket is not closed
            core/build.gradle.kts | }                          | core/build.gradle.kts: a } that nothing opened
            settings.gradle.kts | includeBuild("x")            | settings.gradle.kts: not understood: includeBuild("x")
            settings.gradle.kts | project(":core").name = "other" | \
            settings.gradle.kts: not understood: project(":core").name
            settings.gradle.kts | dependencyResolutionManagement { repositories { maven { url = "x" } } } | \
            settings.gradle.kts: expected
            """)
    void statement_ofAnotherForm_isRefused(@Nullable String file, String statement, String message) throws IOException {
        var dependency = "dependencies {\n" + statement + "\n}";
        write(file == null ? "core/build.gradle.kts" : file, (file == null ? dependency : statement) + "\n");
        assertRefused(() -> GradleReader.read(root), message);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            options.release.set(21)           |         | build.gradle.kts: no options.release.set(..) for JavaCompile
            libs.findLibrary("junit").get()   | "a:b:1" | \
            build.gradle.kts: not understood: "testImplementation"("a:b:1")
            """)
    void rootScript_ofAnotherForm_isRefused(String line, @Nullable String other, String message) throws IOException {
        write("build.gradle.kts", ROOT_SCRIPT.replace(line, other == null ? "" : other));
        assertRefused(() -> GradleReader.read(root), message);
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
    @CsvSource(delimiter = '|', textBlock = """
            [bundles]   | a = "1"                                 | section [bundles] is not understood
            [plugins]   | a = "1"                                 | no other plugin than Kotlin's is understood
            [libraries] | a = { group = "g", name = "n" }         | expected alias = { module
            [libraries] | a = { module = "g:n", version.ref = "v" } | no version named v
            [versions]  | a = { strictly = "1" }                  | not understood, or given twice
            """)
    void catalog_ofAnotherForm_isRefused(String section, String line, String message) {
        assertRefused(() -> new VersionCatalog(section + "\n" + line), message);
    }

    // ---- Maven

    private static Module read(String elements) {
        return PomReader.module(ROOT_POM, "core", "<project>" + POM_HEAD + elements + "</project>");
    }

    @Test
    void module_isReadWhole() {
        var module = read("""
                <description>Actors</description>
                <properties><module.name>a.b</module.name></properties>
                <dependencies><dependency>
                  <groupId>${project.groupId}</groupId><artifactId>sim</artifactId><version>${project.version}</version>
                </dependency></dependencies>
                <build><plugins><plugin><configuration><annotationProcessorPaths>
                  <path>
                    <groupId>org.ow2.asm</groupId><artifactId>asm</artifactId><version>${asm.version}</version>
                  </path>
                </annotationProcessorPaths></configuration></plugin></plugins></build>
                """);
        assertThat(module)
                .isEqualTo(new Module(
                        "Actors",
                        "21",
                        "a.b",
                        List.of(
                                new Dependency(Scope.TEST, "t:junit", "5"),
                                new Dependency(Scope.COMPILE, "g:sim", "1"),
                                new Dependency(Scope.PROCESSOR, "org.ow2.asm:asm", "9.9"))));
    }

    /** A scope as for users of the module: the property has the value from outside of the profiles. */
    @Test
    void exclusionsPropertiesAndReleaseLevel_ofAModule_areRead() {
        var dependency = "<dependencies><dependency><groupId>a</groupId><artifactId>b</artifactId><version>2</version>"
                + "%s</dependency></dependencies>";
        var excluding = read(dependency.formatted(
                "<exclusions><exclusion><groupId>c</groupId><artifactId>d</artifactId>" + "</exclusion></exclusions>"));
        var scoped = read("<properties><inner>runtime</inner></properties>"
                + "<profiles><profile><properties><inner>compile</inner></properties></profile></profiles>"
                + dependency.formatted("<scope>${inner}</scope>"));
        var older = read("<properties><maven.compiler.release>17</maven.compiler.release></properties>");

        assertThat(excluding.dependencies().getLast()).hasToString("compile a:b:2 without [c:d]");
        assertThat(scoped.dependencies().getLast()).hasToString("runtime a:b:2");
        assertThat(older.release()).isEqualTo("17");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            <dependencyManagement/> | core/pom.xml: <dependencyManagement> is not understood
            <dependencies><dependency><groupId>a</groupId><optional>true</optional></dependency></dependencies> | \
            <optional> in a dependency
            <dependencies><dependency><version>${gone}</version></dependency></dependencies> | POM: no property gone
            <dependencies><dependency><type>war</type></dependency></dependencies> | <type>war</type> is not understood
            <dependencies><dependency><scope>system</scope></dependency></dependencies> | scope system is not understood
            <build><x><release>17</release></x></build> | core/pom.xml: <release> is not understood
            <profiles><profile><dependencies/></profile></profiles> | core/pom.xml: <dependencies> in a profile
            <profiles><profile><build><plugin><artifactId>a</artifactId></plugin></build></profile></profiles> | \
            core/pom.xml: the plugin a in a profile
            """)
    void element_thatIsNotUnderstood_isRefused(String element, String message) {
        assertRefused(() -> read(element), message);
    }

    @Test
    void module_withAnotherParentVersion_isRefused() {
        var pom = "<project>" + POM_HEAD.replace("<version>1<", "<version>2<") + "</project>";
        assertThatThrownBy(() -> PomReader.module(ROOT_POM, "core", pom))
                .hasMessage("core/pom.xml: parent's version is 2, expected 1");
    }
}
