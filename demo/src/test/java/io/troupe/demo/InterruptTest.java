package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.PetriNet;
import io.troupe.petri.Pnml;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.ScenarioReader;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Pattern;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.condition.DisabledOnOs;
import org.junit.jupiter.api.condition.OS;
import org.junit.jupiter.api.io.TempDir;

/**
 * An interrupted command reports what it has measured so far. The signal is SIGTERM: the virtual machine handles it
 * like SIGINT, and no shell makes background processes ignore it.
 */
@Timeout(300)
@DisabledOnOs(OS.WINDOWS)
class InterruptTest {
    private static final int TERMINATED = 128 + 15;

    @TempDir
    private Path out;

    /**
     * Runs a command with {@code --out}, interrupts it after the first line that matches the marker, and returns all
     * its lines.
     */
    private List<String> interrupted(String marker, String... arguments) throws IOException, InterruptedException {
        return endedAt(
                marker,
                Stream.concat(Stream.of(arguments), Stream.of("--out", out.toString()))
                        .toList());
    }

    private static List<String> endedAt(String marker, List<String> arguments)
            throws IOException, InterruptedException {
        var command = new ArrayList<>(List.of(
                Path.of(System.getProperty("java.home"), "bin", "java").toString(),
                "-Dtroupe.progress.seconds=0",
                "-cp",
                System.getProperty("java.class.path"),
                Main.class.getName()));
        command.addAll(arguments);
        var process = new ProcessBuilder(command).redirectErrorStream(true).start();
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
        return lines;
    }

    private static String lastLine(Path file) throws IOException {
        return Files.readAllLines(file).getLast();
    }

    @Test
    void run_printsItsSummary_andItsLogSaysThatItWasCutShort() throws Exception {
        assertThat(interrupted(
                        "\\] +[0-9.]+ of 100000", "run", "--world", "worlds/paper-arena.world", "--seconds", "100000"))
                .anyMatch(line -> line.startsWith("distance driven"))
                .anyMatch(line -> line.startsWith("interrupted: "));
        assertThat(lastLine(out.resolve("run.jsonl"))).endsWith(",\"cutShort\":\"interrupted\"}");
    }

    @Test
    void modes_printWhatTheyHave_andDrawNothing() throws Exception {
        assertThat(interrupted("sync mode \\[", "modes", "--world", "worlds/paper-arena.world", "--seconds", "100000"))
                .anyMatch(line -> line.matches("0 +0\\.0 s 1: start"))
                .anyMatch(line -> line.startsWith("interrupted: there is no comparison"));
        assertThat(lastLine(out.resolve("run-sync.jsonl"))).endsWith(",\"cutShort\":\"interrupted\"}");
        assertThat(out.resolve("run-promise.jsonl")).doesNotExist();
        assertThat(out.resolve("modes.svg")).doesNotExist();
    }

    @Test
    void crowd_printsAndWritesTheMeasurementsSoFar() throws Exception {
        assertThat(interrupted("round 3 of 1000", "crowd", "--sizes", "1", "--seconds", "0.1", "--repeat", "1000"))
                .anyMatch(line -> line.matches("interrupted: [0-9]+ measurements of 1000"))
                .anyMatch(line -> line.contains("times real time"));
        assertThat(Files.readAllLines(out.resolve("crowd.csv"))).hasSizeGreaterThanOrEqualTo(3);
    }

    @Test
    void evaluate_printsWhatCompleteRepetitionsSay_andWritesAllThatWasMeasured() throws Exception {
        assertThat(interrupted(
                        "\\] +[2-9] %",
                        "evaluate",
                        "--world",
                        "worlds/paper-arena.cfg",
                        "--loops",
                        "2",
                        "--cores",
                        "2",
                        "--repetitions",
                        "100",
                        "--warm-up",
                        "0",
                        "--seconds",
                        "0.5"))
                .contains("The paper, and what we find")
                .anyMatch(line -> line.matches("interrupted: [1-9][0-9]? of 100 repetitions were complete"))
                .anyMatch(line -> line.matches("wrote [0-9]+ numbers, all that was measured, to .*evaluation\\.csv.*"));
        assertThat(Files.readAllLines(out.resolve("evaluation.csv"))).hasSizeGreaterThan(10);
        assertThat(out.resolve("evaluation-15.svg")).doesNotExist();
        assertThat(out.resolve("evaluation.log")).doesNotExist();
    }

    @Test
    void verifyOfANet_hasPrintedWhatItKnows_andDrawsNothing() throws Exception {
        Path file = out.resolve("growing.pnml");
        Pnml.write(
                PetriNet.builder("growing")
                        .place("a", 2)
                        .place("many")
                        .transition("t")
                        .arc("a", "t", 2)
                        .arc("t", "a", 2) // a weight of 2, so that siphons decide nothing
                        .arc("t", "many")
                        .build(),
                file);
        assertThat(interrupted("markings, [0-9]+ visited", "verify", "--net", file.toString(), "--time", "3600"))
                .anyMatch(line -> line.startsWith("interrupted: what was known until then stands above"));
        assertThat(out.resolve("growing.svg")).doesNotExist();
    }

    @Test
    void app_endsItsComponentsAndSaysHowFarItCame() throws Exception {
        assertThat(endedAt(
                        "^ +[0-9.]+ s  ",
                        List.of(
                                "app",
                                "applications/two-robots.app",
                                "--world",
                                "worlds/paper-arena.cfg",
                                "--seconds",
                                "100000")))
                .anyMatch(line -> line.matches(".* on .*, [0-9.]+ s simulated"));
    }

    @Test
    void replay_saysHowFarItCame() throws Exception {
        Path recording = out.resolve("long.txt");
        int ticks = 300_000;
        try (var file = Files.newBufferedWriter(recording)) {
            var world = World.create(
                    ScenarioReader.read(Path.of("worlds/paper-arena.cfg")).world(), WorldSettings.DEFAULT);
            var open = world.record(file);
            for (int tick = 0; tick < ticks; tick++) {
                world.advance();
            }
            open.close();
        }
        assertThat(endedAt(
                        "[1-9][0-9]* of " + ticks + " ticks",
                        List.of("replay", recording.toString(), "--world", "worlds/paper-arena.cfg")))
                .anyMatch(
                        line -> line.matches("interrupted: [1-9][0-9]* of " + ticks + " ticks of world .* were played"))
                .anyMatch(line -> line.matches("robot1: [0-9.]+ m, [0-9]+ contacts?"));
    }

    @Test
    void verify_hasPrintedWhatItKnows_andWritesNoReport() throws Exception {
        assertThat(interrupted("^More robots", "verify", "--robots", "7"))
                .anyMatch(line -> line.startsWith("  holds "))
                .anyMatch(line -> line.startsWith("interrupted: what was known until then stands above"));
        assertThat(out.resolve("verify.md")).doesNotExist();
    }
}
