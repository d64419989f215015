package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.view.RecordedRun;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** {@code troupe run} in another JVM. */
@Timeout(300)
class RunCommandTest {
    private static final Path WORLD = Path.of("worlds", "paper-arena.world");

    @TempDir
    private Path out;

    @Test
    void interpretedJvm_writesTheSameFile() throws Exception {
        var settings = RecordedRun.Settings.DEFAULT.withSeed(7).withSeconds(20);
        new RecordedRun(ScenarioReader.read(WORLD), SubsumptionTable.ofThePaper(), settings).run(out.resolve("here"));
        var java = Path.of(System.getProperty("java.home"), "bin", "java").toString();
        var interpreted = new ProcessBuilder(
                        java,
                        "-Xint",
                        "-cp",
                        System.getProperty("java.class.path"),
                        "io.troupe.demo.Main",
                        "run",
                        "--world",
                        WORLD.toString(),
                        "--seed",
                        "7",
                        "--seconds",
                        "20",
                        "--out",
                        out.resolve("there").toString())
                .redirectErrorStream(true)
                .redirectOutput(out.resolve("log").toFile())
                .start();
        assertThat(interpreted.waitFor())
                .as(Files.readString(out.resolve("log")))
                .isZero();
        assertThat(out.resolve("there").resolve("run.jsonl")).hasSameBinaryContentAs(out.resolve("here"));
    }
}
