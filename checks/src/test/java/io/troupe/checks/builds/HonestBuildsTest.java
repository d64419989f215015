package io.troupe.checks.builds;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import java.io.IOException;
import java.nio.file.Files;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Lines of the build files that users rely on, and whose loss no other test would notice. */
class HonestBuildsTest {
    private static String file(String path) throws IOException {
        return Files.readString(Repository.root().resolve(path));
    }

    /** jcstress itself exits with 0 if no test ran, or if each ended in an error; LawsMain counts them. */
    @ParameterizedTest
    @ValueSource(strings = {"stress/pom.xml", "stress/build.gradle.kts"})
    void laws_areRunByTheMainThatCountsThem(String script) throws IOException {
        assertThat(file(script)).contains("io.troupe.actor.laws.LawsMain").doesNotContain("org.openjdk.jcstress.Main");
    }

    @Test
    void javaExecTasks_runOnTheRequestedJdk() throws IOException {
        for (String script : List.of("build.gradle.kts", "docs/examples/consumer/build.gradle.kts")) {
            assertThat(file(script)).contains("providers.gradleProperty(\"jdk\")");
        }
        assertThat(file("build.gradle.kts"))
                .contains("tasks.withType<JavaExec>().configureEach { javaLauncher.convention(launcher) }");
    }

    /** Maven's default entry names the JDK that runs Maven, so that the same sources would give different jars. */
    @ParameterizedTest
    @ValueSource(strings = {"maven-jar-plugin", "maven-source-plugin", "maven-javadoc-plugin"})
    void manifests_haveNoEntryOfTheJdkThatRunsMaven(String plugin) throws IOException {
        var managed = file("pom.xml").split("<pluginManagement>")[1].split("</pluginManagement>")[0];
        assertThat(managed.split("<artifactId>" + plugin + "</artifactId>")[1].split("</plugin>")[0])
                .contains("<addDefaultEntries>false</addDefaultEntries>");
        assertThat(managed)
                .as("from 3.4.0 on the jar plugin names that JDK in any case")
                .contains("<artifactId>maven-jar-plugin</artifactId><version>3.3.0</version>");
    }

    /**
     * The start script needs a class path, and other users need the copied libraries; the main job ends in the phase
     * compile.
     */
    @Test
    void filesOfTheStartScript_areWrittenByTheMainJob() throws IOException {
        assertThat(file("README.md")).contains("compile exec:exec -pl demo -am");
        var plugin = file("demo/pom.xml")
                .split("<artifactId>maven-dependency-plugin</artifactId>")[1]
                .split("</plugin>")[0];
        assertThat(plugin.replaceAll("\\s+", ""))
                .contains("<phase>compile</phase><goals><goal>build-classpath</goal></goals>")
                .contains("<phase>compile</phase><goals><goal>copy-dependencies</goal></goals>");
    }

    /** The POMs have their artifact ids checked by {@link PomReader}; Gradle would use the name of the folder. */
    @Test
    void artifactsOfGradle_areCalledAsThoseOfMaven() throws IOException {
        assertThat(file("build.gradle.kts"))
                .contains("archivesName.set(\"troupe-${project.name}\")")
                .contains("artifactId = \"troupe-${project.name}\"");
        assertThat(Module.artifact("services")).isEqualTo("troupe-services");
    }

    /** JMH itself exits with 0 when its forks fail. */
    @Test
    void benchmarksThatFail_failTheirBuild() throws IOException {
        assertThat(file("jmh/pom.xml")).contains("org.openjdk.jmh.Main ${args} -foe true");
        assertThat(file("jmh/build.gradle.kts")).contains("listOf(\"-foe\", \"true\")");
    }

    /** Found with a real Gradle, which no Maven build can replace: each of these lines was missing once. */
    @Test
    void gradleScripts_keepWhatARealGradleNeeds() throws IOException {
        assertThat(file("stress/build.gradle.kts"))
                .as("jcstress takes a missing folder on its class path for an error")
                .contains("filter { it.exists() }");
        assertThat(file("demo/build.gradle.kts"))
                .as("standard input of the command line")
                .contains("doFirst { (this as JavaExec).standardInput = System.`in` }")
                .as("the worlds, beside the scripts that name their folder")
                .contains("\"worlds\"", "troupe.home");
    }

    @Test
    void everyJar_holdsTheLicence() throws IOException {
        assertThat(file("build.gradle.kts"))
                .contains("tasks.withType<Jar>().configureEach { metaInf { from(licence) } }");
        assertThat(file("pom.xml").split("<include>LICENSE</include>", -1))
                .as("classes and sources by one resource, Javadoc by another")
                .hasSize(3);
    }

    @Test
    void wrapperJar_isComparedWithGradlesOwnInCi() throws IOException {
        var workflow = file(".github/workflows/build.yml");
        assertThat(workflow.indexOf("gradle/actions/wrapper-validation@"))
                .as("before ./gradlew runs")
                .isPositive()
                .isLessThan(workflow.indexOf("./gradlew"));
    }
}
