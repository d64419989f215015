package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assumptions.assumeThat;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.petri.PetriNet;
import io.troupe.petri.Pnml;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.ScenarioReader;
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
import java.util.regex.Pattern;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.condition.DisabledOnOs;
import org.junit.jupiter.api.condition.OS;
import org.junit.jupiter.api.parallel.Execution;
import org.junit.jupiter.api.parallel.ExecutionMode;

/**
 * Commands in a separate JVM that are interrupted, commands whose output goes to {@code /dev/full}, and the start
 * script.
 */
@Timeout(300)
@DisabledOnOs(OS.WINDOWS)
@Execution(ExecutionMode.CONCURRENT)
class MainProcessTest extends CommandLineBench {
    private static final int TERMINATED = 128 + 15;
    private static final String CUT_SHORT = ",\"cutShort\":\"interrupted\"}\n";
    private static final Path FULL = Path.of("/dev/full");

    /**
     * Interrupts a command after the first line in which the marker is found; it must print a line of each of the
     * patterns. The signal is SIGTERM: the virtual machine handles it like SIGINT, and no shell makes background
     * processes ignore it.
     */
    private void assertInterrupted(String marker, String arguments, String... patterns) throws Exception {
        var process = jvm("-Dtroupe.progress.seconds=0", Main.class, words(arguments))
                .redirectErrorStream(true)
                .start();
        var lines = new ArrayList<String>();
        try (var output = process.inputReader()) {
            var found = Pattern.compile(marker);
            for (String line = output.readLine(); line != null; line = output.readLine()) {
                if (found != null && found.matcher(line).find()) {
                    process.toHandle().destroy(); // process.destroy() closes its output as well
                    found = null;
                }
                if (!line.startsWith("troupe: [")) {
                    lines.add(line);
                }
            }
        } finally {
            process.destroyForcibly();
        }
        assertThat(process.waitFor()).as(String.join("\n", lines)).isEqualTo(TERMINATED);
        assertThat(patterns)
                .isNotEmpty()
                .allSatisfy(pattern -> assertThat(lines).anyMatch(line -> line.matches(pattern)));
    }

    @Test
    void run_printsItsSummary_andItsLogSaysThatItWasCutShort() throws Exception {
        String run = "run " + ARENA + "--seconds 100000 --out DIR";
        assertInterrupted("\\] +[0-9.]+ of 100000", run, "distance driven.*", "interrupted: .*");
        assertThat(written("run.jsonl")).endsWith(CUT_SHORT);
    }

    @Test
    void modes_printWhatTheyHave_andDrawNothing() throws Exception {
        String modes = "modes " + ARENA + "--seconds 100000 --out DIR";
        assertInterrupted("sync mode \\[", modes, "0 +0\\.0 s 1: start", "interrupted: there is no comparison.*");
        assertThat(written("run-sync.jsonl")).endsWith(CUT_SHORT);
        assertMissing("run-promise.jsonl", "modes.svg");
    }

    @Test
    void crowd_printsAndWritesTheMeasurementsSoFar() throws Exception {
        assertInterrupted(
                "round 3 of 1000",
                "crowd --sizes 1 --seconds 0.1 --repeat 1000 --out DIR",
                "interrupted: [0-9]+ measurements of 1000",
                ".*times real time.*");
        assertThat(Files.readAllLines(directory.resolve("crowd.csv"))).hasSizeGreaterThanOrEqualTo(3);
    }

    @Test
    void evaluate_printsWhatCompleteRepetitionsSay_andWritesAllThatWasMeasured() throws Exception {
        assertInterrupted(
                "\\] +[2-9] %",
                "evaluate --world worlds/paper-arena.cfg --loops 2 --cores 2 --repetitions 100 --warm-up 0"
                        + " --seconds 0.5 --out DIR",
                "The paper, and what we find",
                "interrupted: [1-9][0-9]? of 100 repetitions were complete",
                "wrote [0-9]+ numbers, all that was measured, to .*evaluation\\.csv.*");
        assertThat(Files.readAllLines(directory.resolve("evaluation.csv"))).hasSizeGreaterThan(10);
        assertMissing("evaluation-15.svg", "evaluation.log");
    }

    @Test
    void verifyOfANet_hasPrintedWhatItKnows_andDrawsNothing() throws Exception {
        var net = PetriNet.builder("growing").place("a", 2).place("many").transition("t");
        net.arc("a", "t", 2).arc("t", "a", 2).arc("t", "many"); // a weight of 2, so that siphons decide nothing
        Pnml.write(net.build(), directory.resolve("growing.pnml"));
        assertInterrupted(
                "markings, [0-9]+ visited",
                "verify --net DIR/growing.pnml --time 3600 --out DIR",
                "interrupted: what was known until then stands above.*");
        assertMissing("growing.svg");
    }

    @Test
    void verify_hasPrintedWhatItKnows_andWritesNoReport() throws Exception {
        String interrupted = "interrupted: what was known until then stands above.*";
        assertInterrupted("^Reading A", "verify --out DIR", "  holds .*", interrupted);
        assertMissing("verify.md");
    }

    @Test
    void app_endsItsComponentsAndSaysHowFarItCame() throws Exception {
        String app = "app applications/two-robots.app --world worlds/paper-arena.cfg --seconds 100000 --out DIR/o";
        assertInterrupted("^ +[0-9.]+ s  ", app, ".* on .*, [0-9.]+ s simulated");
    }

    @Test
    void replay_saysHowFarItCame() throws Exception {
        int ticks = 60_000;
        var scenario = ScenarioReader.read(Path.of("worlds/paper-arena.cfg"));
        try (var file = Files.newBufferedWriter(directory.resolve("long.txt"))) {
            var world = World.create(scenario.world(), WorldSettings.defaults());
            var open = world.record(file);
            for (int tick = 0; tick < ticks; tick++) {
                world.advance();
            }
            open.close();
        }
        assertInterrupted(
                "[1-9][0-9]* of " + ticks + " ticks",
                "replay DIR/long.txt --world worlds/paper-arena.cfg",
                "interrupted: [1-9][0-9]* of " + ticks + " ticks of world .* were played",
                "robot1: [0-9.]+ m, [0-9]+ contacts?");
    }

    // ---- on a full disk

    @Test
    @Timeout(120)
    void output_thatCannotBeWritten_isStatus1_butStatus4OfAProof_becauseStatus1IsAVerdict() throws Exception {
        assumeThat(FULL).exists();
        var turning = PetriNet.builder("turning").place("on", 1).place("off");
        turning.transition("end", List.of("on"), List.of("off"));
        Pnml.write(turning.build(), directory.resolve("deadlock.pnml"));
        turning.transition("begin", List.of("off"), List.of("on"));
        Pnml.write(turning.build(), directory.resolve("proved.pnml"));
        assertThat(statusWithFullOutput("--version")).isEqualTo(Main.FAILED);
        assertThat(statusWithFullOutput("verify --net DIR/proved.pnml --out DIR"))
                .isEqualTo(4);
        assertThat(statusWithFullOutput("verify --net DIR/deadlock.pnml --out DIR"))
                .isEqualTo(1);
    }

    private int statusWithFullOutput(String line) throws Exception {
        // keeps progress lines out of the errors
        var command = jvm("-Dtroupe.progress.seconds=600", Main.class, words(line));
        var process = command.redirectOutput(FULL.toFile()).start();
        try (var errors = process.errorReader()) {
            assertThat(errors.lines())
                    .containsExactly("troupe: the output could not be written: No space left on device");
        }
        return process.waitFor();
    }

    // ---- the start script in a built installation

    private static final Path SET_USER = Path.of("/usr/bin/setpriv");

    private Path home;

    private record Outcome(int status, String text) {}

    /** With a stub {@code java} that prints its arguments and a stub {@code mvn} that fails. */
    private void install() throws IOException {
        directory = directory.toRealPath();
        permit(directory, "rwxr-xr-x");
        home = directory.resolve("home");
        script("home/troupe", Files.readString(Path.of("..", "troupe")));
        file("home/demo/target/classpath.txt", "/nowhere/of/the/builder/some.jar");
        file("home/demo/target/lib/some.jar", "");
        file("home/demo/target/classes/io/troupe/demo/Main.class", "");
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
    @Timeout(60)
    void script_buildsAgain_whenTheClassesAreGone() throws Exception {
        install();
        List<String> version = List.of(home.resolve("troupe").toString(), "--version");
        assertThat(run(Map.of(), version).status()).isZero();
        Files.delete(home.resolve("demo/target/classes/io/troupe/demo/Main.class"));
        Outcome outcome = run(Map.of(), version);
        assertThat(outcome.text()).contains("troupe: building", "mvn runs");
        assertThat(outcome.status()).isEqualTo(1);
    }

    @Test
    @Timeout(60)
    void linksToTheScript_leadToItsInstallation_andItsJars_andLocaleCIsNotPassedOn() throws Exception {
        install();
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

        // Java opens no file with an umlaut in it in the locale C
        var command = List.of(home + "/troupe");
        assertThat(run(Map.of("LC_ALL", "C"), command).text()).contains("LC_ALL=C.UTF-8\n");
        assertThat(run(Map.of("LC_ALL", "de_DE.UTF-8"), command).text()).contains("LC_ALL=de_DE.UTF-8\n");
    }

    @Test
    @Timeout(60)
    void installationOfAnotherUser_isNotBuiltAgain() throws Exception {
        install();
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
    @Timeout(60)
    void mavenWithoutAJdk_saysWhatToInstall() throws IOException {
        assertThat(Files.readString(Path.of("..", "pom.xml")))
                .as("Maven prints the id of the execution that fails")
                .containsPattern("<id>install-a-JDK-21-or-later-or-set-JAVA_HOME-to-one</id>"
                        + "<phase>\\$\\{toolchain.phase}</phase><goals><goal>select-jdk-toolchain</goal></goals>");
    }
}
