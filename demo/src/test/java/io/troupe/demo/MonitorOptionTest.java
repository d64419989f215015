package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** {@code --monitor} on the command line. */
@Timeout(180)
class MonitorOptionTest extends CommandLineBench {
    private static final String RUN = "run " + ARENA + "--seconds 3 --out DIR";

    @ParameterizedTest
    @ValueSource(strings = {"promise", "callback", "sync"})
    void run_isFollowed_andWritesTheSameLog(String mode) throws IOException {
        assertThat(printed(RUN + " --mode " + mode)).doesNotContain("monitor:");
        String expected = written("run.jsonl");
        assertThat(printed(RUN + " --monitor --mode " + mode))
                .containsPattern("monitor: [1-9]\\d* events, all as declared for 2 robots in " + mode + " mode");
        assertThat(written("run.jsonl")).isEqualTo(expected);
    }

    @Test
    void runThatIsAlsoShown_isFollowed() {
        assertThat(printed(RUN + " --monitor --html DIR/run.html"))
                .containsPattern("monitor: [1-9]\\d* events, all as declared");
    }

    @Test
    void application_isFollowed() {
        assertThat(
                        printed(
                                "app --world worlds/paper-arena.cfg --out DIR/o --seconds 1 --monitor applications/two-robots.app"))
                .containsPattern("monitor: [1-9]\\d* events of providers, components and messages, all as declared");
    }

    @Test
    void overHosts_itIsRefused() {
        assertRefused(
                "run --robots localhost:6665 --bus nats://localhost:4222 --monitor --out DIR",
                "--monitor is for robots in this process");
    }
}
