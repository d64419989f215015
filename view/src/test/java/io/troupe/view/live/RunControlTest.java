package io.troupe.view.live;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ManualClock;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.BooleanSupplier;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

@Timeout(60)
class RunControlTest {
    private static final BooleanSupplier NEVER = () -> false;

    private final ManualClock wall = new ManualClock();

    /** Asked before each wait, it lets the wall clock advance instead. */
    private BooleanSupplier advancing(long nanos, AtomicInteger asked) {
        return () -> {
            if (asked.getAndIncrement() > 0) {
                wall.advanceTo(wall.nanos() + nanos);
            }
            return false;
        };
    }

    @Test
    void interval_passesWhenItIsDue_atTheWantedSpeed() throws Exception {
        var control = new RunControl(wall, 2, true);
        control.await(0, NEVER);
        var asked = new AtomicInteger();
        control.await(100_000, advancing(10_000_000, asked));
        assertThat(asked.get())
                .as("100 ms at double speed are five waits of 10 ms")
                .isEqualTo(6);
        control.submit(new ViewCommand.Speed(0));
        var fastest = new AtomicInteger();
        control.await(50_000_000, advancing(0, fastest));
        assertThat(fastest.get()).as("no wait").isEqualTo(1);
    }

    @Test
    void pausedTime_passesByStepsOnly_andIsNotCaughtUpWith() throws Exception {
        var control = new RunControl(wall, 1, true);
        control.await(0, NEVER);
        control.submit(new ViewCommand.Pause());
        var asked = new AtomicInteger();
        control.await(100_000, () -> asked.incrementAndGet() > 3);
        assertThat(asked.get()).as("it waited until it was stopped").isEqualTo(4);
        control.submit(new ViewCommand.Step());
        control.await(100_000, NEVER);
        assertThat(control.isPaused()).isTrue();
        wall.advanceTo(wall.nanos() + 3_600_000_000_000L);
        control.submit(new ViewCommand.Resume());
        control.await(200_000, NEVER);
        var again = new AtomicInteger();
        control.await(300_000, advancing(20_000_000, again));
        assertThat(again.get()).as("after an hour of pause, 100 ms are 100 ms").isEqualTo(6);
    }

    @Test
    void interventions_areTakenOnce_theNewestOfAKind() throws Exception {
        var control = new RunControl(wall, 0, true);
        var last = new ViewCommand.Place(0, new Pose(2, 2, 0));
        control.submit(new ViewCommand.Place(0, new Pose(1, 1, 0)));
        control.submit(new ViewCommand.Place(1, new Pose(1, 1, 0)));
        control.submit(last);
        control.submit(new ViewCommand.Drive(1, 1, 0));
        control.submit(new ViewCommand.Drive(1, 0.5, 0));
        assertThat(control.await(0, NEVER))
                .containsExactly(new ViewCommand.Place(1, new Pose(1, 1, 0)), last, new ViewCommand.Drive(1, 0.5, 0));
        assertThat(control.await(100_000, NEVER)).isEmpty();
        control.submit(last);
        control.submit(new ViewCommand.Reset());
        assertThat(control.await(200_000, NEVER)).containsExactly(new ViewCommand.Reset());
    }

    @Test
    void robot_isReleased_whenItsDriverIsSilentForASecond() throws Exception {
        var control = new RunControl(wall, 0, true);
        control.submit(new ViewCommand.Drive(1, 1, 0));
        control.await(0, NEVER);
        wall.advanceTo(wall.nanos() + 900_000_000);
        assertThat(control.await(100_000, NEVER)).isEmpty();
        wall.advanceTo(wall.nanos() + 200_000_000);
        assertThat(control.await(200_000, NEVER)).containsExactly(new ViewCommand.Release(1));
        assertThat(control.await(300_000, NEVER)).isEmpty();
    }

    @Test
    void runWithoutInterventions_refusesThem() {
        var control = new RunControl(wall, 0, false);
        assertThat(control.offers()).containsExactly("pause", "resume", "step", "speed");
        assertThatThrownBy(() -> control.submit(new ViewCommand.Reset())).hasMessageContaining("nothing in it");
    }

    @Test
    void log_isRepeatedAtItsTimes_andItsErrorsHaveALineNumber(@TempDir Path folder) throws Exception {
        Path log = folder.resolve("run.jsonl");
        WorldSpec world = LiveRuns.ARENA.world();
        Files.write(
                log,
                List.of(
                        header(world.name()),
                        "{\"t\":0.3,\"type\":\"intervention\",\"what\":\"release 1\"}",
                        "{\"t\":0.5,\"type\":\"intervention\",\"what\":\"reset\"}"));
        var control = new RunControl(wall, 0, false);
        control.repeat(log, world, Map.of("seed", "1"));
        assertThat(control.await(200_000, NEVER)).isEmpty();
        assertThat(control.await(300_000, NEVER)).containsExactly(new ViewCommand.Release(0));
        assertThat(control.await(500_000, NEVER)).containsExactly(new ViewCommand.Reset());
        for (String wrong : List.of("pause", "release 9")) {
            Files.write(
                    log,
                    List.of(
                            header(world.name()),
                            "{\"t\": 0.3, \"type\": \"intervention\", \"what\": \"" + wrong + "\"}"));
            assertThatThrownBy(() -> control.repeat(log, world, Map.of("seed", "1")))
                    .hasMessageContaining("line 2: ")
                    .hasMessageContaining(wrong.equals("pause") ? "'pause' changes nothing" : "robot '9'");
        }
    }

    private static String header(String world) {
        return "{\"t\":0.0,\"type\":\"header\",\"format\":\"troupe-run\",\"version\":1,\"world\":\"" + world
                + "\",\"robots\":2,\"seed\":1}";
    }
}
