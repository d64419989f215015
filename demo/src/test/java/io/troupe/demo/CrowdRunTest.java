package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.demo.crowd.CrowdTable;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.subsumption.Mode;
import io.troupe.sim.worldfile.CrowdWorld;
import io.troupe.view.Pictures;
import io.troupe.view.RecordedRun;
import io.troupe.view.RunResult;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** Runs of crowds in the real world with real threads. */
@Timeout(300)
class CrowdRunTest {
    private static final int COLOURS = 8;

    @TempDir
    private Path out;

    private static RunResult run(int robots, double holdSeconds, double seconds, Mode mode, Path file)
            throws Exception {
        var table = CrowdTable.of(robots, CrowdWorld.colours(COLOURS), 3, holdSeconds, CornerStyle.FORWARD);
        var settings = RecordedRun.Settings.DEFAULT.withMode(mode).withSeconds(seconds);
        return new RecordedRun(CrowdWorld.scenario(robots, COLOURS), table, settings).run(file);
    }

    @Test
    void thousandRobots_thatAllSwitchInOneTick_haveOneServiceEachAtEveryTick() throws Exception {
        RunResult result = run(1000, 0, 1, Mode.PROMISE, out.resolve("run.jsonl"));

        int switches = result.states().size() - 1;
        assertThat(switches).isPositive();
        assertThat(result.robots()).hasSize(1000).allSatisfy(robot -> {
            assertThat(robot.chargeFaults()).isZero();
            assertThat(robot.ticksWithoutCycle()).isZero();
            assertThat(robot.loops().values().stream()
                            .mapToLong(Long::longValue)
                            .sum())
                    .as("a loop for each reading, and one more for each switch")
                    .isEqualTo(10 + switches);
            assertThat(robot.serviceName())
                    .isEqualTo(result.states()
                            .getLast()
                            .state()
                            .services()
                            .get(robot.index())
                            .name());
        });
    }

    @Test
    void hold_keepsAState() throws Exception {
        RunResult result = run(200, 2, 10, Mode.PROMISE, out.resolve("run.jsonl"));

        assertThat(result.states()).hasSizeBetween(2, 5);
        for (int i = 1; i < result.states().size(); i++) {
            assertThat(result.states().get(i).timeMicros()
                            - result.states().get(i - 1).timeMicros())
                    .isGreaterThanOrEqualTo(2_000_000);
        }
    }

    @Test
    void sameSeed_sameFile_inEveryMode() throws Exception {
        for (Mode mode : Mode.values()) {
            run(50, 1, 5, mode, out.resolve(mode + "1"));
            run(50, 1, 5, mode, out.resolve(mode + "2"));
            assertThat(out.resolve(mode + "2")).hasSameBinaryContentAs(out.resolve(mode + "1"));
        }
    }

    @Test
    void crowd_logsItsPosesOnceASecond_andIsToldOfInSumsAndExtremes() throws Exception {
        Path file = out.resolve("run.jsonl");
        RunResult result = run(50, 1, 3, Mode.PROMISE, file);

        assertThat(Files.readAllLines(file).stream().filter(line -> line.contains("\"type\":\"pose\"")))
                .hasSize(50 * 4);
        assertThat(result.summary())
                .contains("50 robots", "mean", "least", "most", "cycles of avoid > patrol1")
                .doesNotContain("robot 1 ");
        assertThat(result.states().getFirst().describe(result.table()))
                .endsWith("state 1: 16 avoid > patrol1, 17 spaceWanderer, 17 wallFollower");
    }

    @Test
    void picture_ofACrowd_hasAllBodiesAndNoNumbers() throws Exception {
        RunResult result = run(80, 1, 3, Mode.PROMISE, out.resolve("run.jsonl"));
        var world = CrowdWorld.scenario(80, COLOURS).world();

        String svg = Pictures.trajectory(world, result);

        assertThat(svg.split("fill=\"#ffa500\"", -1)).hasSize(80 + 1);
        assertThat(svg).contains("80 robots, 3.0 s simulated").doesNotContain("font-weight=\"bold\"");
    }
}
