package io.troupe.player;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.Replay;
import io.troupe.sim.SnapshotHash;
import java.io.StringReader;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestInstance;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Runs one session in every supported way: all must give the same snapshots, bit for bit. */
@Tag("threads")
@Timeout(120)
@TestInstance(TestInstance.Lifecycle.PER_CLASS)
class DeterminismTableTest {
    private static final int TICKS = 300;
    private static final int INTERPRETED_TICKS = 60;

    private DeterminismSession.Result first = new DeterminismSession.Result("", 0, 0, "");

    @BeforeAll
    void play() throws Exception {
        first = DeterminismSession.inProcess(1, TICKS);
        assertThat(first.contacts()).as("something must have been hit").isPositive();
        assertThat(first.wayM()).as("everybody's way").isGreaterThan(10);
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 2, 4})
    void sensingThreads_giveTheSameSnapshots(int threads) throws Exception {
        assertThat(DeterminismSession.inProcess(threads, TICKS).hash()).isEqualTo(first.hash());
    }

    @Test
    void tcpInPullMode_givesTheSameSnapshots() throws Exception {
        assertThat(DeterminismSession.overTcp(TICKS).hash()).isEqualTo(first.hash());
    }

    @Test
    void recording_givesTheSameSnapshots() throws Exception {
        var hash = new SnapshotHash();
        Replay.read(new StringReader(first.recording()))
                .play(DeterminismSession.scenario().world(), snapshot -> {
                    if (snapshot.tick() > 0 && snapshot.tick() <= TICKS) {
                        hash.update(snapshot);
                    }
                });
        assertThat(hash.toString()).isEqualTo(first.hash());
    }

    @Test
    void interpretedJvm_givesTheSameSnapshots() throws Exception {
        Process process = new ProcessBuilder(
                        Path.of(System.getProperty("java.home"), "bin", "java").toString(),
                        "-Xint",
                        "-cp",
                        System.getProperty("java.class.path"),
                        DeterminismSession.class.getName(),
                        "" + INTERPRETED_TICKS)
                .redirectErrorStream(true)
                .start();
        String said = new String(process.getInputStream().readAllBytes(), StandardCharsets.UTF_8);
        assertThat(process.waitFor(100, TimeUnit.SECONDS)).isTrue();

        assertThat(said.strip())
                .isEqualTo(DeterminismSession.inProcess(1, INTERPRETED_TICKS).hash());
    }
}
