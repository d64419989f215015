package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.view.RecordedRun;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** {@code troupe run}, {@code troupe modes} and {@code troupe crowd}. */
@Timeout(300)
class RunCommandTest extends CommandLineBench {
    @Test
    void run_printsChangesAndSummary_andWritesBothFiles() {
        assertThat(printed("run " + ARENA + "--seconds 2 --out DIR/o"))
                .contains("state 1: robot 1 wallFollower, robot 2 spaceWanderer", "times real time", "distance driven");
        assertThat(directory.resolve("o/run.jsonl")).isNotEmptyFile();
        assertThat(directory.resolve("o/trajectory.svg")).isNotEmptyFile();
        assertThat(err.toString()).isEmpty();
        assertThat(printed(ARENA + "--seconds 1 --out DIR/o"))
                .as("options without a command are those of run")
                .contains("1.0 s simulated");
    }

    @Test
    void longRun_saysFirstHowLargeItsFilesGet() {
        assertThat(RunCommand.Sizes.of(2, 100, 100_000))
                .satisfies(sizes -> assertThat(sizes.areLarge()).isTrue())
                .extracting(RunCommand.Sizes::describe)
                .isEqualTo("320 MB in run.jsonl and at most 24 MB in trajectory.svg");
        assertThat(RunCommand.Sizes.of(2, 100, 300).areLarge()).isFalse();
    }

    /** The run fails at once, since the log file is a directory. */
    @Test
    void logThatCannotBeWritten_isOneLine_andALongRunWarnsBeforeIt() throws IOException {
        Files.createDirectories(directory.resolve("run.jsonl"));
        String command = "run " + ARENA + "--out DIR --seconds ";
        assertThat(troupe(command + "1")).isEqualTo(1);
        assertThat(err.toString().lines()).singleElement().asString().contains("run.jsonl");
        err.getBuffer().setLength(0);
        assertThat(troupe(command + "100000")).isEqualTo(1);
        assertThat(err.toString().lines())
                .startsWith("troupe: warning: --seconds is 100000.0: expect about "
                        + "320 MB in run.jsonl and at most 24 MB in trajectory.svg");
    }

    @Test
    void interpretedJvm_writesTheSameFile() throws Exception {
        var settings = RecordedRun.Settings.DEFAULT.withSeed(7).withSeconds(20);
        var scenario = ScenarioReader.read(Path.of("worlds", "paper-arena.world"));
        new RecordedRun(scenario, SubsumptionTable.ofThePaper(), settings).run(directory.resolve("here"));
        Path log = directory.resolve("log");
        var run = jvm("-Xint", Main.class, words("run " + ARENA + "--seed 7 --seconds 20 --out DIR/there"));
        var interpreted = run.redirectErrorStream(true).redirectOutput(log.toFile()).start();
        assertThat(interpreted.waitFor()).as(Files.readString(log)).isZero();
        assertThat(directory.resolve("there/run.jsonl")).hasSameBinaryContentAs(directory.resolve("here"));
    }

    @Test
    void table_ofAFile_worksWithACrowdToo() {
        assertThat(printed("run --robots 2 --table tables/paper.table --seconds 1 --out DIR"))
                .contains("crowd of 2", "state 3 (green)");
    }

    @ParameterizedTest
    @CsvSource({"8, 3", "5, 4"})
    void crowd_isGenerated(int colours, int services) {
        String text = printed(
                "run --robots 50 --seconds 1 --out DIR --colours " + colours + " --services " + services);

        assertThat(text).contains("crowd of 50", "50 robots ");
        assertThat(text.lines().filter(line -> line.matches("state \\d+ \\(.+\\): \\d+ times?, .+ s")))
                .as("states, one for each colour")
                .hasSize(colours);
        var all = List.of("spaceWanderer", "wallFollower", "avoid > patrol1", "avoid > patrol2");
        assertThat(text.lines().filter(line -> line.startsWith("cycles of ")))
                .extracting(line -> line.split(" {2,}")[0].substring("cycles of ".length()))
                .containsExactlyInAnyOrderElementsOf(all.subList(0, services));
        assertThat(directory.resolve("run.jsonl"))
                .content()
                .contains("\"robot\":50,")
                .doesNotContain("\"robot\":51,");
        assertThat(directory.resolve("trajectory.svg")).content().contains("50 robots, 1.0 s simulated");
        assertThat(err.toString()).isEmpty();
    }

    @Test
    void crowd_isMeasured() {
        assertThat(printed("crowd --sizes 1,4 --seconds 0.5 --repeat 1 --out DIR"))
                .contains("us of processor time", "crowd.svg");
        assertThat(directory.resolve("crowd.csv")).content().hasLineCount(3);
        assertThat(directory.resolve("crowd.svg")).content().contains("<svg");
        assertThat(directory.resolve("crowd.png")).isNotEmptyFile();
    }

    @Test
    void run_inCallbackMode_tellsItsMessages_andItsTicksWithoutAService() {
        assertThat(printed("run " + ARENA + "--seconds 100 --mode CALLBACK --reconnect --out DIR"))
                .contains("callback mode with reconnection, seed 1")
                .containsPattern("readings with no or several services +1 +1\\R")
                .containsPattern("colours sent by colour finders: [1-9][0-9]+ in 1 state change,");
    }

    private String logWithoutItsMode(String mode) throws IOException {
        String log = Files.readString(directory.resolve("run-" + mode + ".jsonl"));
        String field = ",\"mode\":\"" + mode + "\"";
        assertThat(log.lines().findFirst().orElse("")).contains(field);
        return log.replace(field, "");
    }

    @Test
    void modes_showsWhereSynchronousModeDiffers_andThatCallbackModeDoesNot() throws Exception {
        String text = printed("modes " + ARENA + "--seconds 100 --out DIR");
        assertThat(err.toString()).isEmpty();
        assertThat(text)
                .contains("sync mode", "callback mode", "promise mode", "*  46.1 s 3: robot 2 sees green")
                .contains("callback mode: the same states at the same times and the same trajectories")
                .contains("as each waits for the cycles of the others. The robots are elsewhere from 0.1 s on");
        assertThat(text.lines().filter(line -> line.contains("*  "))).hasSize(1);
        assertThat(text.lines().takeWhile(line -> !line.startsWith("*")))
                .as("the table")
                .hasSizeGreaterThan(2)
                .allSatisfy(line -> assertThat(line).hasSizeLessThanOrEqualTo(100));

        String promise = logWithoutItsMode("promise");
        String sync = logWithoutItsMode("sync");
        assertThat(logWithoutItsMode("callback")).isEqualTo(promise).isNotEqualTo(sync);
        String picture = Files.readString(directory.resolve("modes.svg"));
        assertThat(picture).doesNotContain("#00ff00");
        var svg = ParsedSvg.parse(picture);
        assertThat(svg.elements("g"))
                .as("bars, one for each state")
                .hasSize((promise + promise + sync).split("\"type\":\"state\"", -1).length - 1);
        assertThat(svg.title())
                .matches("States compared with promise mode: sync differs from [0-9.]+ s on,"
                        + " callback does not differ \\(paper arena, seed 1\\)");
    }
}
