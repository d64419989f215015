package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.Pnml;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Assumptions;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** Error messages of the commands on {@code /dev/full}. */
@Timeout(120)
class FullDiskTest {
    private static final Path FULL = Path.of("/dev/full");

    @TempDir
    private Path directory;

    @BeforeEach
    void requireDevice() {
        Assumptions.assumeTrue(Files.exists(FULL));
    }

    @Test
    void log_thatCannotBeWritten_isNamed_andTheSummaryIsKept() throws IOException {
        Path log = Files.createSymbolicLink(directory.resolve("run.jsonl"), FULL);
        var out = new StringWriter();
        var err = new StringWriter();
        int status = Main.execute(
                new PrintWriter(out),
                new PrintWriter(err),
                "run",
                "--world",
                "worlds/paper-arena.world",
                "--seconds",
                "20",
                "--out",
                directory.toString());
        assertThat(status).isEqualTo(Main.FAILED);
        assertThat(err.toString().lines()).containsExactly("troupe: " + log + ": No space left on device");
        assertThat(out.toString()).contains("20.0 s simulated", "distance driven");
    }

    @Test
    void output_thatCannotBeWritten_isStatus1() throws Exception {
        assertThat(statusWithFullOutput("--version")).isEqualTo(Main.FAILED);
    }

    @Test
    void proof_thatCannotBeWritten_isStatus4_becauseStatus1IsAVerdict() throws Exception {
        Path net = directory.resolve("net.pnml");
        Pnml.write(PaperNets.corrected(Reading.A), net);
        assertThat(statusWithFullOutput("verify", "--net", net.toString(), "--out", directory.toString()))
                .isEqualTo(4);
    }

    @Test
    void deadlock_thatCannotBeWritten_isStillStatus1() throws Exception {
        Path net = directory.resolve("net.pnml");
        Pnml.write(PaperNets.uncorrected(Reading.A), net);
        assertThat(statusWithFullOutput("verify", "--net", net.toString(), "--out", directory.toString()))
                .isEqualTo(1);
    }

    private static int statusWithFullOutput(String... arguments) throws IOException, InterruptedException {
        var command = new ArrayList<>(List.of(
                Path.of(System.getProperty("java.home"), "bin", "java").toString(),
                "-Dtroupe.progress.seconds=600", // keeps progress lines out of the errors
                "-cp",
                System.getProperty("java.class.path"),
                Main.class.getName()));
        command.addAll(List.of(arguments));
        var process = new ProcessBuilder(command).redirectOutput(FULL.toFile()).start();
        try (var err = process.errorReader()) {
            assertThat(err.lines()).containsExactly("troupe: the output could not be written: No space left on device");
        }
        return process.waitFor();
    }
}
