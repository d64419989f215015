package io.troupe.player;

import static io.troupe.sim.TestWorlds.BLACK;
import static io.troupe.sim.TestWorlds.robot;
import static io.troupe.sim.TestWorlds.wall;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;
import io.troupe.sim.Simulation;
import io.troupe.sim.Snapshot;
import io.troupe.sim.TestWorlds;
import io.troupe.sim.UnansweredTickException;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.WorldSpec;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicReference;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Programs in the style of Player's students, in lock step with a world, on real threads. */
@Tag("threads")
@Timeout(60)
class PlayerClientTest {
    private static final int PORT = 6700;

    private final WorldSpec world = TestWorlds.world(
            List.of(robot("one", 0, 0, 0), robot("two", 0, 3, 0)), wall("east", 4.1, 0, 0.2, 10, BLACK));
    private final Simulation simulation = Simulation.open(TestWorlds.scenario(PORT, world), WorldSettings.DEFAULT);

    @AfterEach
    void close() {
        simulation.close();
    }

    private List<Snapshot> ticks(int count) {
        var snapshots = new ArrayList<Snapshot>();
        for (int tick = 0; tick < count; tick++) {
            snapshots.add(simulation.tick());
        }
        return snapshots;
    }

    /** Runs a program on a separate thread until it ends or its server closes. */
    private static Thread program(Runnable code) {
        var thread = Thread.ofPlatform().daemon().unstarted(() -> {
            try {
                code.run();
            } catch (PlayerException serverHasGone) {
                // ends every endless program
            }
        });
        thread.start();
        return thread;
    }

    /** Drives ahead until a wall is near; waits for data in a busy loop, as all the examples do. */
    private void busyProgram(int index, CountDownLatch connected) {
        PlayerClient robot = new PlayerClient("localhost", PORT);
        Position2DInterface pos = robot.requestInterfacePosition2D(index, PlayerConstants.PLAYER_OPEN_MODE);
        SonarInterface son = robot.requestInterfaceSonar(index, PlayerConstants.PLAYER_OPEN_MODE);
        robot.runThreaded(-1, -1);
        connected.countDown();
        while (true) {
            while (!son.isDataReady())
                ;
            float[] ranges = son.getData().getRanges();
            for (int i = 0; i < son.getData().getRanges_count(); i++) {
                ranges[i] = Math.min(ranges[i], 4f); // clamps the array in place
            }
            if (ranges[1] > 1) {
                pos.setSpeed(0.4, 0);
            } else {
                pos.setSpeed(0, 0);
            }
        }
    }

    private void await(CountDownLatch latch) throws InterruptedException {
        assertThat(latch.await(30, TimeUnit.SECONDS)).isTrue();
    }

    @Test
    void busyPrograms_ofTwoRobots_driveTheSameWayEveryTime() throws Exception {
        var runs = new ArrayList<List<Snapshot>>();
        for (int run = 0; run < 2; run++) {
            try (var own = Simulation.open(TestWorlds.scenario(PORT + 1, world), WorldSettings.DEFAULT)) {
                var connected = new CountDownLatch(2);
                for (int index = 0; index < 2; index++) {
                    int robot = index;
                    program(() -> {
                        PlayerClient client = new PlayerClient("localhost", PORT + 1);
                        var pos = client.requestInterfacePosition2D(robot, PlayerConstants.PLAYER_OPEN_MODE);
                        var son = client.requestInterfaceSonar(robot, PlayerConstants.PLAYER_OPEN_MODE);
                        client.runThreaded(-1, -1);
                        connected.countDown();
                        while (true) {
                            while (!son.isDataReady())
                                ;
                            pos.setSpeed(son.getData().getRanges()[1] > 1 ? 0.4 : 0, 0.1 * robot);
                        }
                    });
                }
                await(connected);
                var snapshots = new ArrayList<Snapshot>();
                for (int tick = 0; tick < 150; tick++) {
                    snapshots.add(own.tick());
                }
                runs.add(snapshots);
            }
        }
        assertThat(runs.getFirst()).isEqualTo(runs.getLast());
        assertThat(runs.getFirst().getLast().robots().getFirst().pose().x()).isGreaterThan(1);
    }

    @Test
    void busyProgram_stopsInFrontOfTheWall_andItsClampingHarmsNobody() throws Exception {
        var connected = new CountDownLatch(1);
        program(() -> busyProgram(0, connected));
        await(connected);
        Snapshot end = ticks(120).getLast();
        assertThat(end.robots().getFirst().pose().x()).isBetween(2.9, 3.1);
        assertThat(end.robots().get(1).sonarM().get(1)).isCloseTo(4, within(1e-9));
    }

    @Test
    void commands_countFromTheNextTick_andStayUntilTheNextOne() {
        var client = new PlayerClient("localhost", PORT);
        var pos = client.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
        client.runThreaded(-1, -1);
        pos.setSpeed(0.5, 0);
        program(() -> {
            while (true) {
                pos.isDataReady();
            }
        });
        List<Snapshot> snapshots = ticks(3);
        assertThat(snapshots)
                .extracting(snapshot -> snapshot.robots().getFirst().pose().x())
                .satisfiesExactly(
                        x -> assertThat(x).isCloseTo(0.05, within(1e-9)),
                        x -> assertThat(x).isCloseTo(0.10, within(1e-9)),
                        x -> assertThat(x).isCloseTo(0.15, within(1e-9)));
        client.close();
        assertThat(ticks(1).getFirst().robots().getFirst().pose().x())
                .as("nobody drives it any more")
                .isCloseTo(0.15, within(1e-9));
    }

    @Test
    void readAll_deliversOneMessageACall_inOrder() throws Exception {
        var read = new ArrayList<String>();
        var done = new CountDownLatch(1);
        var connected = new CountDownLatch(1);
        program(() -> {
            PlayerClient robot = new PlayerClient("localhost", PORT);
            SonarInterface son = robot.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
            Position2DInterface pos = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
            connected.countDown();
            for (int i = 0; i < 4; i++) {
                assertThat(robot.readAll()).isEqualTo(PlayerConstants.PLAYER_MSGTYPE_DATA);
                read.add((pos.isDataReady() ? "p" : "") + (son.isDataReady() ? "s" : ""));
            }
            done.countDown();
            robot.close();
        });
        await(connected);
        ticks(2);
        await(done);
        assertThat(read).containsExactly("p", "s", "p", "s");
    }

    @Test
    void readAll_inPullMode_deliversAFrame() throws Exception {
        var read = new ArrayList<String>();
        var connected = new CountDownLatch(1);
        var done = new CountDownLatch(1);
        program(() -> {
            PlayerClient robot = new PlayerClient("localhost", PORT);
            robot.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
            var pos = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
            var son = robot.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
            connected.countDown();
            for (int i = 0; i < 2; i++) {
                assertThat(robot.readAll()).isEqualTo(PlayerConstants.PLAYER_MSGTYPE_SYNCH);
                read.add((pos.isDataReady() ? "p" : "") + (son.isDataReady() ? "s" : "") + son.getTimestamp());
            }
            done.countDown();
            robot.close();
        });
        await(connected);
        ticks(2);
        await(done);
        assertThat(read).containsExactly("ps0.0", "ps0.1");
    }

    @Test
    void programThatExtendsPlayerClient_andOldAndNewPoses_work() throws Exception {
        class MyRobot extends PlayerClient {
            private final Position2DInterface wheels = requestInterfacePosition2D(1, PlayerConstants.PLAYER_OPEN_MODE);

            MyRobot() {
                super("localhost", PORT);
                wheels.setVelocity(new PlayerPose2d(0.3, 0, 0), 1);
                wheels.setVelocity(new PlayerPose(0.2, 0, 0), 1);
            }
        }
        var robot = new MyRobot();
        robot.runThreaded(-1, -1);
        robot.wheels.queryGeometry();
        assertThat(robot.wheels.isGeomReady()).isTrue();
        assertThat(robot.wheels.isGeomReady()).isFalse();
        assertThat(robot.wheels.getGeom().getSize().getSl()).isEqualTo(0.4);
        program(() -> {
            while (true) {
                robot.wheels.isDataReady();
            }
        });
        ticks(1);
        assertThat(simulation.latest().robots().get(1).pose().x()).isCloseTo(0.02, within(1e-9));
        PlayerPose pose = robot.wheels.getData().getPos();
        PlayerPose2d sameAgain = robot.wheels.getData().getPos();
        assertThat(pose).isSameAs(sameAgain);
        robot.close();
    }

    @Test
    void deviceThatDoesNotExist_namesThoseThatDo() {
        var client = new PlayerClient("localhost", PORT);
        assertThatThrownBy(() -> client.requestInterfaceSonar(7, PlayerConstants.PLAYER_OPEN_MODE))
                .isInstanceOf(PlayerException.class)
                .hasMessage(
                        "[PlayerClient] Requested device sonar:7 is not in the device list. It has: position2d:0, sonar:0, blobfinder:0, "
                                + "position2d:1, sonar:1, blobfinder:1");
        client.close();
    }

    @Test
    void serverThatDoesNotExist_namesThePortsThatAreOpen() {
        assertThatThrownBy(() -> new PlayerClient("localhost", 6999))
                .isInstanceOf(PlayerException.class)
                .hasMessageContaining("localhost:6999")
                .hasMessageContaining("" + PORT);
    }

    @Test
    void secondWorldOnAPort_isRefused() {
        assertThatThrownBy(() -> Simulation.open(TestWorlds.scenario(PORT, world), WorldSettings.DEFAULT))
                .isInstanceOf(PlayerException.class)
                .hasMessageContaining("port " + PORT + " is in use");
    }

    @Test
    void clientThatDoesNotAnswer_isNamed() {
        var client = new PlayerClient("localhost", PORT);
        client.requestInterfaceSonar(1, PlayerConstants.PLAYER_OPEN_MODE);
        simulation.answerLimit(Duration.ofMillis(20));
        assertThatThrownBy(simulation::tick)
                .isInstanceOf(UnansweredTickException.class)
                .hasMessageContaining("tick 0")
                .hasMessageContaining("client 1 on port " + PORT + " (sonar:1)");
        client.close();
    }

    @Test
    void clientWithoutSubscription_isNotWaitedFor() {
        new PlayerClient("localhost", PORT);
        simulation.answerLimit(Duration.ofSeconds(30));
        assertThat(simulation.tick().tick()).isEqualTo(1);
    }

    @Test
    void closedWorld_endsEveryWaitingCall() throws Exception {
        var failures = new ArrayList<Thread>();
        var ended = new CountDownLatch(3);
        var reader = new PlayerClient("localhost", PORT);
        reader.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
        var busy = new PlayerClient("localhost", PORT);
        var sonar = busy.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
        busy.runThreaded(-1, -1);
        var promise = busy.nextData();
        failures.add(Thread.ofPlatform()
                .start(() -> endsWithPlayerException(
                        () -> {
                            while (true) {
                                reader.readAll();
                            }
                        },
                        ended)));
        failures.add(Thread.ofPlatform()
                .start(() -> endsWithPlayerException(
                        () -> {
                            while (!sonar.isDataReady())
                                ;
                        },
                        ended)));
        failures.add(Thread.ofPlatform()
                .start(() -> endsWithPlayerException(
                        () -> {
                            try {
                                promise.get(Duration.ofSeconds(30));
                            } catch (InterruptedException | java.util.concurrent.TimeoutException e) {
                                throw new IllegalStateException(e);
                            }
                        },
                        ended)));
        simulation.close();
        assertThat(ended.await(30, TimeUnit.SECONDS)).isTrue();
        busy.join();
        assertThatThrownBy(() -> busy.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE))
                .isInstanceOf(PlayerException.class);
    }

    private static void endsWithPlayerException(Runnable code, CountDownLatch ended) {
        try {
            code.run();
        } catch (PlayerException expected) {
            ended.countDown();
        }
    }

    @Test
    void clientOnAnActorSpace_isToldByAPromise_andItsWholeTurnIsItsAnswer() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("robots").withClock(simulation.clock()))) {
            var seen = new ArrayList<String>();
            var client = new AtomicReference<PlayerClient>();
            var begun = new CountDownLatch(1);
            space.execute(() -> {
                var robot = new PlayerClient("localhost", PORT);
                var pos = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
                robot.runThreaded(-1, -1);
                client.set(robot);
                space.repeatWhile(
                                () -> true,
                                () -> robot.nextData().thenAccept(ready -> {
                                    seen.add(pos.isDataReady() + " at "
                                            + simulation.clock().nanos() / 1_000_000);
                                    // a chain of turns that all belong to this tick
                                    space.execute(() -> space.execute(() -> pos.setSpeed(pos.getX() + 0.1, 0)));
                                }))
                        .exceptionally(lost -> null);
            });
            space.onIdle(begun::countDown);
            await(begun);
            assertThat(ticks(2).getLast().robots().getFirst().pose().x()).isCloseTo(0.01 + 0.011, within(1e-9));
            assertThat(seen).containsExactly("true at 0", "true at 100");
            client.get().close();
        }
    }
}
