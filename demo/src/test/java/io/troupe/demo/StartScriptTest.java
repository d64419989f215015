package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.FileTime;
import java.nio.file.attribute.PosixFilePermissions;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import org.junit.jupiter.api.Assumptions;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.condition.DisabledOnOs;
import org.junit.jupiter.api.condition.OS;
import org.junit.jupiter.api.io.TempDir;

/**
 * The start script in a built installation, with a stub {@code java} that prints its arguments and a stub {@code mvn}
 * that fails.
 */
@Timeout(60)
@DisabledOnOs(OS.WINDOWS)
class StartScriptTest {
    private static final Path SET_USER = Path.of("/usr/bin/setpriv");

    @TempDir
    private Path directory;

    private Path home;

    private record Outcome(int status, String text) {}

    @BeforeEach
    void install() throws IOException {
        directory = directory.toRealPath();
        Files.setPosixFilePermissions(directory, PosixFilePermissions.fromString("rwxr-xr-x"));
        home = directory.resolve("home");
        Path target = Files.createDirectories(home.resolve("demo/target"));
        script(home.resolve("troupe"), Files.readString(Path.of("..", "troupe")));
        Files.writeString(target.resolve("classpath.txt"), "/nowhere/of/the/builder/some.jar");
        Files.writeString(Files.createDirectories(target.resolve("lib")).resolve("some.jar"), "");
        Path jdk = Files.createDirectories(directory.resolve("jdk/bin"));
        script(jdk.resolve("java"), "#!/bin/sh\nprintf '%s\\n' \"$@\" \"LC_ALL=$LC_ALL\"\n");
        script(jdk.resolve("javac"), "#!/bin/sh\n");
        Files.writeString(directory.resolve("jdk/release"), "JAVA_VERSION=\"21.0.1\"\n");
        script(Files.createDirectories(directory.resolve("path")).resolve("mvn"), "#!/bin/sh\necho mvn runs\nexit 1\n");
    }

    private static void script(Path file, String text) throws IOException {
        Files.writeString(file, text);
        Files.setPosixFilePermissions(file, PosixFilePermissions.fromString("rwxr-xr-x"));
    }

    private Outcome run(Map<String, String> environment, List<String> command)
            throws IOException, InterruptedException {
        var builder = new ProcessBuilder(command).redirectErrorStream(true);
        builder.environment().put("JAVA_HOME", directory.resolve("jdk").toString());
        builder.environment().put("PATH", directory.resolve("path") + ":" + System.getenv("PATH"));
        builder.environment().putAll(environment);
        var process = builder.start();
        String text = new String(process.getInputStream().readAllBytes(), java.nio.charset.StandardCharsets.UTF_8);
        return new Outcome(process.waitFor(), text);
    }

    private Outcome run(Path script) throws IOException, InterruptedException {
        return run(Map.of(), List.of(script.toString(), "--version"));
    }

    @Test
    void linksToTheScript_leadToItsInstallation() throws Exception {
        Path first = Files.createSymbolicLink(home.resolve("t"), Path.of("troupe"));
        Path bin = Files.createDirectories(directory.resolve("bin"));
        Path link = Files.createSymbolicLink(bin.resolve("troupe"), Path.of("..", "home", "t"));
        for (Path script : List.of(first, link)) {
            assertThat(run(script)).satisfies(outcome -> {
                assertThat(outcome.text()).contains("-Dtroupe.home=" + home + "\n", "--version");
                assertThat(outcome.status()).isZero();
            });
        }
    }

    @Test
    void jarsBesideTheBuild_areTaken_sinceTheBuildersRepositoryMayBeOutOfReach() throws Exception {
        assertThat(run(home.resolve("troupe")).text())
                .contains("\n" + home + "/demo/target/classes:" + home + "/demo/target/lib/some.jar\n");
    }

    @Test
    void localeC_isNotPassedOn_sinceJavaOpensNoFileWithAnUmlautInIt() throws Exception {
        var command = List.of(home.resolve("troupe").toString());
        assertThat(run(Map.of("LC_ALL", "C"), command).text()).contains("LC_ALL=C.UTF-8\n");
        assertThat(run(Map.of("LC_ALL", "de_DE.UTF-8"), command).text()).contains("LC_ALL=de_DE.UTF-8\n");
    }

    @Test
    void installationOfAnotherUser_isNotBuiltAgain() throws Exception {
        Files.writeString(home.resolve("pom.xml"), "");
        Files.setLastModifiedTime(home.resolve("pom.xml"), FileTime.from(Instant.parse("2100-01-01T00:00:00Z")));
        assertThat(asAnotherUser())
                .satisfies(outcome -> assertThat(outcome.text())
                        .contains("the sources are newer than the build, which you", "-Dtroupe.home=" + home)
                        .doesNotContain("mvn runs"))
                .extracting(Outcome::status)
                .isEqualTo(0);

        Files.delete(home.resolve("demo/target/lib/some.jar"));
        assertThat(asAnotherUser())
                .satisfies(outcome -> assertThat(outcome.text())
                        .contains("may not write to\n    " + home, "Let the user who may run")
                        .doesNotContain("mvn runs"))
                .extracting(Outcome::status)
                .isEqualTo(1);
    }

    private Outcome asAnotherUser() throws IOException, InterruptedException {
        Path demo = home.resolve("demo");
        var writable = Files.getPosixFilePermissions(demo);
        Files.setPosixFilePermissions(demo, PosixFilePermissions.fromString("r-xr-xr-x"));
        try {
            var command = new ArrayList<String>();
            if (Files.isWritable(demo)) { // as root: the script runs as an unprivileged user
                Assumptions.assumeTrue(Files.exists(SET_USER));
                command.addAll(List.of(SET_USER.toString(), "--reuid=65534", "--clear-groups"));
            }
            command.add(home.resolve("troupe").toString());
            return run(Map.of(), command);
        } finally {
            Files.setPosixFilePermissions(demo, writable);
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
