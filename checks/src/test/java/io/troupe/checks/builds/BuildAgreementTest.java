package io.troupe.checks.builds;

import static io.troupe.checks.Repository.text;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import io.troupe.checks.builds.Build.Dependency;
import io.troupe.checks.builds.Build.Module;
import io.troupe.checks.builds.Build.Scope;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.TreeSet;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

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
        var gradle = new Build("Gradle", "g", "1", new TreeMap<>(), Map.of("core", SAMPLE));
        var maven = new Build("Maven", "g", "2", new TreeMap<>(), Map.of());
        assertThat(gradle.differencesTo(maven))
                .containsExactly("version is \"1\" in Gradle, \"2\" in Maven", "module core: only in Gradle");
    }

    @Test
    void difference_inAProgramOrTheOwner_isNamed() {
        var programs = new TreeMap<>(Map.of("nets", "-Xmx1g a.Nets"));
        var module = new Module("Actors", "21", "a", new TreeSet<>(), programs, List.of(ASM));
        var owner = new TreeMap<>(Map.of("owner.url", "https://a.example"));
        var gradle = new Build("Gradle", "g", "1", owner, Map.of("core", module));
        var maven = new Build("Maven", "g", "1", new TreeMap<>(), Map.of("core", SAMPLE));
        assertThat(gradle.differencesTo(maven))
                .containsExactly(
                        "owner.url is \"https://a.example\" in Gradle, \"\" in Maven",
                        "core: nets is \"-Xmx1g a.Nets\" in Gradle, \"\" in Maven");
    }

    /** Else {@code gradle run} starts other programs beside the main job, with the same arguments. */
    @Test
    void run_isTheMainJobAlone() throws IOException {
        for (Build build : List.of(GradleReader.read(Repository.root()), PomReader.read(Repository.root()))) {
            var running = build.modules().entrySet().stream()
                    .filter(module -> module.getValue().programs().containsKey("run"));
            assertThat(running.map(Map.Entry::getKey)).as(build.tool()).containsExactly("demo");
        }
        for (Path module : Repository.modules()) {
            var script = Files.readString(module.resolve("build.gradle.kts"));
            assertThat(script.matches("(?s).*plugins \\{[^}]*\\bapplication\\b.*"))
                    .as(module + " has the plugin application")
                    .isEqualTo(module.endsWith("demo"));
            assertThat(script).as("a task of that name").doesNotContainPattern("register(<\\w+>)?\\(\"run\"");
        }
    }

    private static void assertDifference(Module maven, String message) {
        var gradle = new Build("Gradle", "g", "1", new TreeMap<>(), Map.of("core", SAMPLE));
        var other = new Build("Maven", "g", "1", new TreeMap<>(), Map.of("core", maven));
        assertThat(gradle.differencesTo(other)).containsExactly(message);
    }

    private static Module module(Dependency... dependencies) {
        return new Module("Actors", "21", "a", List.of(dependencies));
    }

    // ---- lines of the build files that users rely on, and whose loss no other test would notice

    /** Those of {@code filter}, {@code doFirst}, {@code worlds} and {@code home} were found with a real Gradle. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            stress/pom.xml          | io.troupe.actor.laws.LawsMain         | the main that counts the laws runs them
            stress/build.gradle.kts | io.troupe.actor.laws.LawsMain         | the main that counts the laws runs them
            build.gradle.kts        | providers.gradleProperty("jdk")       | JavaExec tasks run on the requested JDK
            docs/examples/consumer/build.gradle.kts | providers.gradleProperty("jdk") | as above
            docs/examples/consumer-kotlin/build.gradle.kts | providers.gradleProperty("jdk") | as above
            docs/examples/consumer-service/build.gradle.kts | providers.gradleProperty("jdk") | as above
            docs/examples/consumer-kotlin/pom.xml | <kotlin.compiler.daemon>false</kotlin.compiler.daemon> | \
            no process outlives the build
            build.gradle.kts        | tasks.withType<JavaExec>().configureEach { javaLauncher.convention(launcher) } | \
            as above
            build.gradle.kts        | archivesName.set("troupe-${project.name}") | Gradle would use the folder
            build.gradle.kts        | artifactId = "troupe-${project.name}" | Gradle would use the folder
            jmh/pom.xml             | io.troupe.bench.JmhMain               | JMH exits with 0 when its forks fail
            jmh/build.gradle.kts    | io.troupe.bench.JmhMain               | JMH exits with 0 when its forks fail
            pom.xml                 | <executable>${java.command}</executable><skip>true</skip> | only what is named starts
            pom.xml                 | <name>${owner.name}</name>            | of the developer
            pom.xml                 | <url>${owner.url}</url>               | of the project
            pom.xml                 | <connection>scm:git:${owner.scm}</connection> | of the sources
            pom.xml                 | <url>${owner.scm}</url>               | of the sources
            build.gradle.kts        | url.set(owner("url"))                 | of the project
            build.gradle.kts        | developer { name.set(owner("name")); url.set(owner("url")) } | of the developer
            build.gradle.kts        | scm { connection.set(owner("scm").map { "scm:git:$it" }); url.set(owner("scm")) } | \
            of the sources
            stress/build.gradle.kts | filter { it.exists() } | jcstress takes a missing folder for an error
            demo/build.gradle.kts   | doFirst { (this as JavaExec).standardInput = System.`in` } | \
            input of the command line
            demo/build.gradle.kts   | "worlds"                              | the worlds, beside the scripts
            demo/build.gradle.kts   | troupe.home                           | the scripts name the folder of the worlds
            build.gradle.kts        | tasks.withType<Jar>().configureEach { metaInf { from(licence) } } | in every jar
            gradle.properties       | kotlin.compiler.execution.strategy=in-process | no process outlives the build
            actor-kotlin/pom.xml    | <kotlin.compiler.daemon>false</kotlin.compiler.daemon> | \
            no process outlives the build
            actor-kotlin/build.gradle.kts | tasks.named<Jar>("javadocJar") { from("README.md") } | says where the KDoc is
            actor-kotlin/pom.xml    | <include>README.md</include>          | says where the KDoc is
            README.md               | compile exec:exec -pl demo -am        | the main job ends in the phase compile
            """)
    void buildFile_keepsTheLineThatUsersNeed(String file, String line, String reason) throws IOException {
        assertThat(text(file)).as(reason).contains(line);
    }

    /** jcstress itself exits with 0 if no test ran, or if each ended in an error. */
    @Test
    void laws_areNotRunByTheMainOfJcstress() throws IOException {
        assertThat(text("stress/pom.xml") + text("stress/build.gradle.kts"))
                .doesNotContain("org.openjdk.jcstress.Main");
    }

    /** Maven's default entry names the JDK that runs Maven, so that the same sources would give different jars. */
    @ParameterizedTest
    @ValueSource(strings = {"maven-jar-plugin", "maven-source-plugin", "maven-javadoc-plugin"})
    void manifests_haveNoEntryOfTheJdkThatRunsMaven(String plugin) throws IOException {
        var managed = text("pom.xml").split("<pluginManagement>")[1].split("</pluginManagement>")[0];
        assertThat(managed.split("<artifactId>" + plugin + "</artifactId>")[1].split("</plugin>")[0])
                .contains("<addDefaultEntries>false</addDefaultEntries>");
        assertThat(managed)
                .as("from 3.4.0 on the jar plugin names that JDK in any case")
                .contains("<artifactId>maven-jar-plugin</artifactId><version>3.3.0</version>");
    }

    /** The start script needs a class path, and other users need the copied libraries. */
    @Test
    void filesOfTheStartScript_areWrittenByTheMainJob() throws IOException {
        var plugin = text("demo/pom.xml").split("<artifactId>maven-dependency-plugin</artifactId>")[1];
        assertThat(plugin.split("</plugin>")[0].replaceAll("\\s+", ""))
                .contains("<phase>compile</phase><goals><goal>build-classpath</goal></goals>")
                .contains("<phase>compile</phase><goals><goal>copy-dependencies</goal></goals>");
    }

    /** {@code -Downtests=NAME} skips the tests of all modules but that one. */
    @Test
    void everyModule_canBeTestedAlone() throws IOException {
        for (Path module : Repository.modules()) {
            assertThat(Files.readString(module.resolve("pom.xml")))
                    .contains("<name>owntests</name><value>" + module.getFileName() + "</value>");
        }
    }

    /** In Maven the file switches the entry off by itself. The module {@code checks} has no jar. */
    @Test
    void everyModule_hasAModuleInfo_orAnAutomaticName() throws IOException {
        var modules = GradleReader.read(Repository.root()).modules();
        for (Path module : Repository.modules()) {
            var name = modules.get(module.getFileName().toString()).automaticName();
            if (module.endsWith("checks")) {
                continue;
            }
            assertThat(name.isEmpty())
                    .as(module + " has no Automatic-Module-Name")
                    .isEqualTo(Files.exists(module.resolve("src/main/java/module-info.java")));
        }
    }

    /** As many modules at a time, and JVMs with the same options unless the tests are thorough. */
    @Test
    void testsOfBothBuilds_runInTheSameWay() throws IOException {
        var options = text("pom.xml")
                .split("<tests.options>")[1]
                .split("</tests.options>")[0]
                .split(" ");
        assertThat(text("build.gradle.kts")).contains("jvmArgs(\"" + String.join("\", \"", options) + "\")");
        var lanes = text(".mvn/maven.config").strip().substring("-T".length());
        assertThat(text("gradle.properties")).contains("org.gradle.workers.max=" + lanes, "org.gradle.parallel=true");
    }

    @Test
    void artifacts_haveTheNameOfTheProject() {
        assertThat(Build.Module.artifact("services")).isEqualTo("troupe-services");
    }

    @Test
    void everyJarOfMaven_holdsTheLicence() throws IOException {
        assertThat(text("pom.xml").split("<include>LICENSE</include>", -1))
                .as("classes and sources by one resource, Javadoc by another")
                .hasSize(3);
    }

    @Test
    void wrapperJar_isComparedWithGradlesOwnInCi() throws IOException {
        var workflow = text(".github/workflows/build.yml");
        assertThat(workflow.indexOf("gradle/actions/wrapper-validation@"))
                .as("before ./gradlew runs")
                .isPositive()
                .isLessThan(workflow.indexOf("./gradlew"));
    }
}
