package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.FileTime;
import java.nio.file.attribute.PosixFilePermissions;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.condition.DisabledOnOs;
import org.junit.jupiter.api.condition.OS;

/**
 * The start script in a built installation, with a stub {@code java} that prints its arguments and a stub {@code mvn}
 * that fails.
 */
@Timeout(60)
@DisabledOnOs(OS.WINDOWS)
class StartScriptTest extends CommandLineBench {
    private static final Path SET_USER = Path.of("/usr/bin/setpriv");

    private Path home;

    private record Outcome(int status, String text) {}

    @BeforeEach
    void install() throws IOException {
        directory = directory.toRealPath();
        permit(directory, "rwxr-xr-x");
        home = directory.resolve("home");
        script("home/troupe", Files.readString(Path.of("..", "troupe")));
        file("home/demo/target/classpath.txt", "/nowhere/of/the/builder/some.jar");
        file("home/demo/target/lib/some.jar", "");
        script("jdk/bin/java", "#!/bin/sh\nprintf '%s\\n' \"$@\" \"LC_ALL=$LC_ALL\"\n");
        script("jdk/bin/javac", "#!/bin/sh\n");
        file("jdk/release", "JAVA_VERSION=\"21.0.1\"\n");
        script("path/mvn", "#!/bin/sh\necho mvn runs\nexit 1\n");
    }

    private void script(String name, String text) throws IOException {
        permit(file(name, text), "rwxr-xr-x");
    }

    private static void permit(Path file, String permissions) throws IOException {
        Files.setPosixFilePermissions(file, PosixFilePermissions.fromString(permissions));
    }

    private Outcome run(Map<String, String> environment, List<String> command) throws Exception {
        var builder = new ProcessBuilder(command).redirectErrorStream(true);
        builder.environment().put("JAVA_HOME", directory.resolve("jdk").toString());
        builder.environment().put("PATH", directory.resolve("path") + ":" + System.getenv("PATH"));
        builder.environment().putAll(environment);
        var process = builder.start();
        String text = new String(process.getInputStream().readAllBytes(), StandardCharsets.UTF_8);
        return new Outcome(process.waitFor(), text);
    }

    @Test
    void linksToTheScript_leadToItsInstallation_whoseJarsAreTakenSinceTheBuildersRepositoryMayBeOutOfReach()
            throws Exception {
        Path first = Files.createSymbolicLink(home.resolve("t"), Path.of("troupe"));
        Path bin = Files.createDirectories(directory.resolve("bin"));
        Path link = Files.createSymbolicLink(bin.resolve("troupe"), Path.of("..", "home", "t"));
        for (Path script : List.of(first, link)) {
            Outcome outcome = run(Map.of(), List.of(script.toString(), "--version"));
            assertThat(outcome.text()).contains("-Dtroupe.home=" + home + "\n", "--version");
            assertThat(outcome.status()).isZero();
        }

        assertThat(run(Map.of(), List.of(home + "/troupe", "--version")).text())
                .contains("\n" + home + "/demo/target/classes:" + home + "/demo/target/lib/some.jar\n");
    }

    @Test
    void localeC_isNotPassedOn_sinceJavaOpensNoFileWithAnUmlautInIt() throws Exception {
        var command = List.of(home + "/troupe");
        assertThat(run(Map.of("LC_ALL", "C"), command).text()).contains("LC_ALL=C.UTF-8\n");
        assertThat(run(Map.of("LC_ALL", "de_DE.UTF-8"), command).text()).contains("LC_ALL=de_DE.UTF-8\n");
    }

    @Test
    void installationOfAnotherUser_isNotBuiltAgain() throws Exception {
        Path pom = file("home/pom.xml", "");
        Files.setLastModifiedTime(pom, FileTime.from(Instant.parse("2100-01-01T00:00:00Z")));
        Outcome older = asAnotherUser();
        assertThat(older.text())
                .contains("the sources are newer than the build, which you", "-Dtroupe.home=" + home)
                .doesNotContain("mvn runs");
        assertThat(older.status()).isZero();

        Files.delete(home.resolve("demo/target/lib/some.jar"));
        Outcome incomplete = asAnotherUser();
        assertThat(incomplete.text())
                .contains("may not write to\n    " + home, "Let the user who may run")
                .doesNotContain("mvn runs");
        assertThat(incomplete.status()).isEqualTo(1);
    }

    private Outcome asAnotherUser() throws Exception {
        Path demo = home.resolve("demo");
        permit(demo, "r-xr-xr-x");
        try {
            var command = new ArrayList<String>();
            if (Files.isWritable(demo)) { // as root: the script runs as an unprivileged user
                assumeTrue(Files.exists(SET_USER));
                command.addAll(List.of(SET_USER.toString(), "--reuid=65534", "--clear-groups"));
            }
            command.add(home + "/troupe");
            return run(Map.of(), command);
        } finally {
            permit(demo, "rwxr-xr-x");
        }
    }

    @Test
    void mavenWithoutAJdk_saysWhatToInstall() throws IOException {
        assertThat(Files.readString(Path.of("..", "pom.xml")))
                .as("Maven prints the id of the execution that fails")
                .containsPattern("<id>install-a-JDK-21-or-later-or-set-JAVA_HOME-to-one</id>"
                        + "<goals><goal>select-jdk-toolchain</goal></goals>");
    }
}
