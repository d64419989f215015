package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.sim.Recording;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.CrowdWorld;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** {@code troupe export}. */
@Timeout(180)
class ExportCommandTest extends CommandLineBench {
    private static final String EXPORT = "export " + ARENA;

    private void run(String options) {
        printed("run " + options + " --seconds 3 --out DIR");
    }

    @Test
    void run_isWrittenInBothFormats() throws IOException {
        run(ARENA);
        String text = printed(EXPORT + "DIR/run.jsonl --mcap DIR/run.mcap --csv DIR/tables");
        assertThat(text.lines())
                .satisfiesExactly(
                        mcap -> assertThat(mcap).matches("wrote .*run\\.mcap \\(0\\.\\d MB\\): 31 readings, 3\\.0 s"),
                        csv -> assertThat(csv).matches("wrote the tables in .*tables: 31 readings, 3\\.0 s"));
        assertThat(err.toString()).isEmpty();
        assertWritten("run.mcap", "tables/poses.csv", "tables/ranges.csv", "tables/states.csv", "tables/log.csv");
        assertThat(written("tables/poses.csv").lines()).hasSize(1 + 2 * 31);
    }

    @Test
    void crowd_isWritten_withOneWarning() throws IOException {
        run("--robots 12 --colours 4");
        printed("export --crowd 12 --colours 4 DIR/run.jsonl --mcap DIR/run.mcap --csv DIR/tables");
        assertThat(err.toString())
                .isEqualToNormalizingNewlines(
                        "troupe: warning: an MCAP file of 11 robots or more has no sensor readings,"
                                + " expected --sensors 1,2,.. or --csv for these\n");
        assertThat(written("tables/ranges.csv").lines()).as("once a second").hasSize(1 + 12 * 4);
    }

    @Test
    void recordingOfAServedCrowd_isWritten() throws IOException {
        try (var world = World.create(CrowdWorld.scenario(2).world(), WorldSettings.defaults());
                var out = Files.newBufferedWriter(directory.resolve("recording"))) {
            Recording recording = world.record(out);
            world.advance();
            recording.close();
        }
        assertThat(printed("export --crowd 2 DIR/recording --csv DIR/tables"))
                .endsWith("2 readings, 0.1 s" + System.lineSeparator());
    }

    @Test
    void runThatWasCutShort_isWritten_withAWarning() throws IOException {
        run(ARENA);
        String whole = written("run.jsonl");
        file("run.jsonl", whole.substring(0, whole.length() / 2));
        printed(EXPORT + "DIR/run.jsonl --csv DIR/tables");
        assertThat(err.toString())
                .startsWith("troupe: warning: the run has no end: the program was killed, or the disk was full");
    }

    @Test
    void wrongOptions_areRefused() throws IOException {
        file("run.jsonl", "hello\n");
        assertRefused(EXPORT + "DIR/run.jsonl", "troupe: nothing to write, expected --mcap FILE or --csv ");
        assertRefused(EXPORT + "DIR/none.jsonl --csv DIR/t", "DIR/none.jsonl: no such file, expected a run.jsonl");
        assertRefused(EXPORT + "DIR/run.jsonl --mcap DIR", "--mcap is DIR, but that is a directory, expected a file");
        assertRefused(EXPORT + "DIR/run.jsonl --mcap DIR/no/m", "but there is no directory DIR/no");
        assertRefused(EXPORT + "DIR/run.jsonl --mcap DIR/run.jsonl", "which is the run, expected another file");
        assertRefused(EXPORT + "DIR/run.jsonl --csv DIR/run.jsonl", "is a file, expected a directory");
        assertRefused(EXPORT + "DIR/run.jsonl --mcapp DIR/m", "there is no option --mcapp; did you mean --mcap?");
        assertRefused(
                EXPORT + "--crowd 3 DIR/run.jsonl --csv DIR/t", "--crowd and --world are both given, expected one");
        assertRefused("export --colours 3 DIR/run.jsonl --csv DIR/t", "--colours is 3, but there is no crowd");
        assertRefused("export --crowd 0 DIR/run.jsonl --csv DIR/t", "--crowd is 0, expected a number from 1 to");
        assertMissing("t", "m");
    }

    @Test
    void wrongRuns_areRefused_andLeaveNoFile() throws IOException {
        file("run.jsonl", "hello\n");
        assertRefused(EXPORT + "DIR/run.jsonl --mcap DIR/m", "troupe: DIR/run.jsonl:1:1: 'h', expected a JSON object");
        run(ARENA);
        assertRefused(
                "export --world worlds/office.world DIR/run.jsonl --mcap DIR/m",
                "DIR/run.jsonl:1:1: the run was in world 'paper arena' with 2 robots, but worlds/office.world is ");
        file("recording", "troupe-recording 1\n");
        assertRefused(EXPORT + "DIR/recording --mcap DIR/m", "DIR/recording: the recording is cut off after line 1");
        assertMissing("m");
    }

    @Test
    void fullDisk_isAFailure() {
        assumeTrue(Files.exists(Path.of("/dev/full")), "there is no /dev/full here: not tested");
        run(ARENA);
        assertFails(
                Main.FAILED, EXPORT + "DIR/run.jsonl --mcap /dev/full", "troupe: /dev/full: No space left on device");
    }

    @Test
    void help_showsBothCommandLines() {
        assertThat(printed("export --help"))
                .contains(
                        "troupe export out/run.jsonl --mcap out/run.mcap",
                        "troupe export out/run.jsonl --csv out/tables");
    }
}
