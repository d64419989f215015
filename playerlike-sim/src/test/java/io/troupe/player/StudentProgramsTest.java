package io.troupe.player;

import static io.troupe.sim.TestWorlds.BLACK;
import static io.troupe.sim.TestWorlds.RED;
import static io.troupe.sim.TestWorlds.robot;
import static io.troupe.sim.TestWorlds.wall;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.player.structures.PlayerConstants;
import io.troupe.sim.Simulation;
import io.troupe.sim.SimulationRunner;
import io.troupe.sim.Snapshot;
import io.troupe.sim.TestWorlds;
import io.troupe.sim.UnansweredTickException;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.WorldSpec;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.stream.Stream;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/**
 * Programs as students write them, against a world that runs by itself: every run is the same, whatever the speed of
 * the programs.
 */
@Tag("threads")
@Timeout(120)
class StudentProgramsTest implements PlayerConstants {
    private static final int PORT = 6770;
    private static final int TICKS = 150;
    private static final WorldSpec WORLD = TestWorlds.world(
            List.of(robot("one", 0, 0, 0), robot("two", 0, 3, 0)),
            wall("east", 4.1, 0, 0.2, 10, BLACK),
            wall("box", 3, 1.5, 0.5, 0.5, RED));

    /** Spends an unpredictable amount of time. */
    private static final class Dawdler {
        private final Random random;

        Dawdler(long seed) {
            random = new Random(seed);
        }

        void dawdle() {
            for (int turns = random.nextInt(2_000); turns > 0; turns--) {
                Thread.onSpinWait();
            }
        }
    }

    /** The style in which a program reads its data. */
    enum Style {
        BUSY_WAIT {
            @Override
            void drive(int index, Dawdler dawdler) {
                PlayerClient client = new PlayerClient("localhost", PORT);
                Position2DInterface pos = client.requestInterfacePosition2D(index, PLAYER_OPEN_MODE);
                SonarInterface son = client.requestInterfaceSonar(index, PLAYER_OPEN_MODE);
                client.runThreaded(-1, -1);
                while (true) {
                    while (!son.isDataReady())
                        ;
                    float[] ranges = son.getData().getRanges();
                    for (int i = 0; i < ranges.length; i++) {
                        ranges[i] = Math.min(ranges[i], 2f);
                    }
                    dawdler.dawdle();
                    pos.setSpeed(ranges[1] > 1 ? 0.4 : 0, ranges[1] > 1 ? 0.05 * pos.getX() : 0.3);
                }
            }
        },

        READ_ALL {
            @Override
            void drive(int index, Dawdler dawdler) {
                PlayerClient client = new PlayerClient("localhost", PORT);
                Position2DInterface pos = client.requestInterfacePosition2D(index, PLAYER_OPEN_MODE);
                SonarInterface son = client.requestInterfaceSonar(index, PLAYER_OPEN_MODE);
                double x = 0;
                while (true) {
                    client.requestData();
                    client.readAll();
                    if (pos.isDataReady()) {
                        x = pos.getX();
                    }
                    dawdler.dawdle();
                    if (son.isDataReady()) {
                        dawdler.dawdle();
                        pos.setSpeed(son.getData().getRanges()[1] > 1 ? 0.4 : 0, 0.1 - 0.05 * x);
                    }
                }
            }
        },

        SUBCLASS_THAT_ASKS_ONE_BY_ONE {
            /** Two reactions that contradict each other: the order of their commands matters. */
            final class Robot extends PlayerClient {
                private final Position2DInterface pos;
                private final SonarInterface son;
                private final BlobfinderInterface blf;

                Robot(int index) {
                    super("localhost", PORT);
                    pos = requestInterfacePosition2D(index, PLAYER_OPEN_MODE);
                    son = requestInterfaceSonar(index, PLAYER_OPEN_MODE);
                    blf = requestInterfaceBlobfinder(index, PLAYER_OPEN_MODE);
                    runThreaded(-1, -1);
                }

                void live(Dawdler dawdler) {
                    while (true) {
                        if (blf.isDataReady() && blf.getData().getBlobs_count() > 0) {
                            pos.setSpeed(0.1, 0.2);
                        }
                        dawdler.dawdle();
                        if (pos.isDataReady()) {
                            pos.setSpeed(0.4, 0.1 * Math.sin(pos.getX()));
                        }
                        dawdler.dawdle();
                        if (son.isDataReady() && son.getData().getRanges()[1] < 1) {
                            pos.setSpeed(0, 0.3);
                        }
                    }
                }
            }

            @Override
            void drive(int index, Dawdler dawdler) {
                new Robot(index).live(dawdler);
            }
        },

        ALWAYS_COMMANDING {
            @Override
            void drive(int index, Dawdler dawdler) {
                PlayerClient client = new PlayerClient("localhost", PORT);
                Position2DInterface pos = client.requestInterfacePosition2D(index, PLAYER_OPEN_MODE);
                client.runThreaded(-1, -1);
                double speed = 0;
                while (true) {
                    if (pos.isDataReady()) {
                        speed = 0.2 + 0.1 * pos.getX();
                    }
                    dawdler.dawdle();
                    pos.setSpeed(speed, 0.1); // also without new data: such a command counts for the next tick
                }
            }
        };

        abstract void drive(int index, Dawdler dawdler);
    }

    /** Two robots, each driven by a program on a separate thread. */
    private static List<Snapshot> run(Style style, long seed) throws InterruptedException {
        var snapshots = new ArrayList<Snapshot>();
        var enough = new CountDownLatch(1);
        List<Thread> programs;
        try (var simulation = Simulation.open(TestWorlds.scenario(PORT, WORLD), WorldSettings.DEFAULT);
                var runner = SimulationRunner.start(simulation, 2, snapshot -> {
                    if (snapshots.size() < TICKS) {
                        snapshots.add(snapshot);
                    } else {
                        enough.countDown();
                    }
                })) {
            assertThat(runner.isRunning()).isTrue();
            programs = Stream.of(0, 1)
                    .map(index -> Thread.ofPlatform().daemon().start(() -> {
                        try {
                            style.drive(index, new Dawdler(seed + index));
                        } catch (PlayerException serverHasGone) {
                            // ends every endless program
                        }
                    }))
                    .toList();
            assertThat(enough.await(60, TimeUnit.SECONDS)).isTrue();
        }
        for (var program : programs) {
            program.join();
        }
        return snapshots;
    }

    @ParameterizedTest
    @EnumSource
    void programs_ofTwoRobots_driveTheSameWayEveryTime_whateverTimeTheyTake(Style style) throws Exception {
        List<Snapshot> first = run(style, 1);
        assertThat(first).hasSize(TICKS);
        assertThat(first.getLast().robots())
                .allSatisfy(robot -> assertThat(robot.pose().x()).as("it drove").isGreaterThan(0.5));
        for (long seed = 2; seed <= 4; seed++) {
            assertThat(run(style, seed)).as("times of seed %d", seed).isEqualTo(first);
        }
    }

    @Test
    void runner_standsStill_untilAllHaveBegun() throws Exception {
        var ticks = new CountDownLatch(3);
        try (var simulation = Simulation.open(TestWorlds.scenario(PORT, WORLD), WorldSettings.DEFAULT);
                var runner = SimulationRunner.start(simulation, 2, snapshot -> ticks.countDown())) {
            assertThat(runner.isRunning()).isTrue();
            var clients = new ArrayList<PlayerClient>();
            for (int index = 0; index < 2; index++) {
                var client = new PlayerClient("localhost", PORT);
                var pos = client.requestInterfacePosition2D(index, PLAYER_OPEN_MODE);
                assertThat(simulation.latest().tick()).isZero();
                client.runThreaded(-1, -1);
                clients.add(client);
                Thread.ofPlatform().daemon().start(() -> {
                    try {
                        while (true) {
                            pos.isDataReady();
                        }
                    } catch (PlayerException closed) {
                        // ends the program
                    }
                });
            }
            assertThat(ticks.await(30, TimeUnit.SECONDS)).isTrue();
            clients.forEach(PlayerClient::close);
        }
    }

    @Test
    void runner_endsByAnUnansweredTick_andTellsEverybody() throws Exception {
        try (var simulation = Simulation.open(TestWorlds.scenario(PORT, WORLD), WorldSettings.DEFAULT)) {
            simulation.answerLimit(Duration.ofMillis(20));
            var runner = SimulationRunner.start(simulation, 1, snapshot -> {});
            var silent = new PlayerClient("localhost", PORT);
            var son = silent.requestInterfaceSonar(1, PLAYER_OPEN_MODE);
            silent.runThreaded(-1, -1);
            silent.join(); // its thread ends when the server closes
            assertThat(son.isDataReady()).as("the first frame was for it").isTrue();
            assertThatThrownBy(son::isDataReady)
                    .isInstanceOf(PlayerException.class)
                    .hasMessageContaining("tick 0 was not answered")
                    .hasMessageContaining("sonar:1");
            assertThatThrownBy(runner::close).isInstanceOf(UnansweredTickException.class);
            assertThat(runner.isRunning()).isFalse();
        }
    }
}
