package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Assumptions;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** What the system's device for a full disk shows. */
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
        var process = new ProcessBuilder(
                        Path.of(System.getProperty("java.home"), "bin", "java").toString(),
                        "-cp",
                        System.getProperty("java.class.path"),
                        Main.class.getName(),
                        "--version")
                .redirectOutput(FULL.toFile())
                .start();
        try (var err = process.errorReader()) {
            assertThat(err.readLine()).isEqualTo("troupe: the output could not be written: No space left on device");
        }
        assertThat(process.waitFor()).isEqualTo(Main.FAILED);
    }
}
