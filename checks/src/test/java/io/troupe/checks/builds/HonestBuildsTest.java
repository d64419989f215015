package io.troupe.checks.builds;

import static io.troupe.checks.Repository.text;
import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** Lines of the build files that users rely on, and whose loss no other test would notice. */
class HonestBuildsTest {
    /** Those of {@code filter}, {@code doFirst}, {@code worlds} and {@code home} were found with a real Gradle. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            stress/pom.xml          | io.troupe.actor.laws.LawsMain         | the main that counts the laws runs them
            stress/build.gradle.kts | io.troupe.actor.laws.LawsMain         | the main that counts the laws runs them
            build.gradle.kts        | providers.gradleProperty("jdk")       | JavaExec tasks run on the requested JDK
            docs/examples/consumer/build.gradle.kts | providers.gradleProperty("jdk") | as above
            build.gradle.kts        | tasks.withType<JavaExec>().configureEach { javaLauncher.convention(launcher) } | as above
            build.gradle.kts        | archivesName.set("troupe-${project.name}") | Gradle would use the name of the folder
            build.gradle.kts        | artifactId = "troupe-${project.name}" | Gradle would use the name of the folder
            jmh/pom.xml             | org.openjdk.jmh.Main ${args} -foe true | JMH exits with 0 when its forks fail
            jmh/build.gradle.kts    | listOf("-foe", "true")                | JMH exits with 0 when its forks fail
            stress/build.gradle.kts | filter { it.exists() }                | jcstress takes a missing folder for an error
            demo/build.gradle.kts   | doFirst { (this as JavaExec).standardInput = System.`in` } | input of the command line
            demo/build.gradle.kts   | "worlds"                              | the worlds, beside the scripts
            demo/build.gradle.kts   | troupe.home                           | the scripts name the folder of the worlds
            build.gradle.kts        | tasks.withType<Jar>().configureEach { metaInf { from(licence) } } | in every jar
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
