package io.troupe.player;

import static io.troupe.player.wire.Interfaces.BLOBFINDER;
import static io.troupe.player.wire.Interfaces.POSITION2D;
import static io.troupe.player.wire.Interfaces.SONAR;
import static io.troupe.sim.TestWorlds.BLACK;
import static io.troupe.sim.TestWorlds.RED;
import static io.troupe.sim.TestWorlds.robot;
import static io.troupe.sim.TestWorlds.wall;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.PlayerPose2d;
import io.troupe.player.wire.ConnectionClosedException;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.Frame;
import io.troupe.player.wire.Interfaces;
import io.troupe.sim.RobotReading;
import io.troupe.sim.Simulation;
import io.troupe.sim.TestWorlds;
import io.troupe.sim.UnansweredTickException;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.ObstacleSpec;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.function.BiConsumer;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/**
 * The definition of a tick. At the wire level the client acts inside the delivery, so nothing depends on threads; then
 * programs in the style of Player's students, on real threads, and clients on actor spaces.
 */
@Tag("threads")
@Timeout(60)
class LockStepTest implements PlayerConstants {
    private static final int PORT = 6760;

    private Simulation simulation = open(Math.PI, wall("east", 3, 0, 0.2, 1, RED));

    private static Simulation open(double headingOfTwoRad, ObstacleSpec wall) {
        var robots = List.of(robot("one", 0, 0, 0), robot("two", 0, 3, headingOfTwoRad));
        return Simulation.open(TestWorlds.scenario(PORT, TestWorlds.world(robots, wall)), WorldSettings.defaults());
    }

    @AfterEach
    void close() {
        simulation.close();
    }

    private void ticks(int count) {
        for (int tick = 0; tick < count; tick++) {
            simulation.tick();
        }
    }

    private RobotReading reading(int robot) {
        return simulation.latest().robots().get(robot);
    }

    private void assertX(int robot, double expected) {
        assertThat(reading(robot).pose().x()).isCloseTo(expected, within(1e-9));
    }

    // ---- at the wire level

    /** A client of robot one. */
    private static WireClient client(Interfaces type, BiConsumer<WireClient, Frame> move) {
        return new WireClient(PORT, move).subscribe(type, 0);
    }

    @Test
    void command_beforeTheAnswer_countsForThisTick_afterItForTheNext() {
        var client = client(POSITION2D, (self, frame) -> {
            self.drive(0, 0.1);
            self.answer(frame);
            self.drive(0, 0.5);
        });
        simulation.tick();
        assertX(0, 0.01);
        client.drive(0, 0.2); // between two ticks: newer than the 0.5, and also after the answer
        simulation.tick();
        assertX(0, 0.02); // 0.1 again, sent in the delivery of the second tick
    }

    @Test
    void command_afterTheAnswer_countsForTheNextTick_ifNothingNewerIsSaid() {
        client(POSITION2D, (self, frame) -> {
            self.answer(frame);
            if (frame.tick() == 0) {
                self.drive(0, 0.5);
            }
        });
        simulation.tick();
        assertThat(reading(0).pose().x()).isZero();
        simulation.tick();
        assertX(0, 0.05);
    }

    @Test
    void twoClientsOfOneRobot_theOneThatConnectedLastWins_whoeverSpeaksFirst() {
        var first = client(POSITION2D, (self, frame) -> {});
        client(POSITION2D, (self, frame) -> {
            self.drive(0, 0.4);
            self.answer(frame);
            first.drive(0, 0.1);
            first.answer(frame);
        });
        simulation.tick();
        assertX(0, 0.04);
    }

    @Test
    void frame_hasTheSubscribedDevicesOnly_inTheOrderOfRobotsAndDevices_inSimulatedTime() {
        var client = new WireClient(PORT, WireClient.ANSWER)
                .subscribe(BLOBFINDER, 1)
                .subscribe(SONAR, 0)
                .subscribe(POSITION2D, 1)
                .subscribe(BLOBFINDER, 0);
        ticks(2);
        assertThat(client.frames.getLast().timeSeconds()).isEqualTo(0.1);
        assertThat(client.frames.getLast().messages())
                .allSatisfy(message -> assertThat(message.timeSeconds()).isEqualTo(0.1))
                .extracting(message -> Interfaces.name(message.from().interfaceCode()) + ":"
                        + message.from().index())
                .containsExactly("sonar:0", "blobfinder:0", "position2d:1", "blobfinder:1");
        assertThat(((DeviceData.Blobs) client.newest(BLOBFINDER, 0)).width())
                .as("sees the red wall")
                .isEqualTo(80);
        assertThat(client.newest(BLOBFINDER, 1)).as("sees nothing").isEqualTo(new DeviceData.Blobs(0, 0, List.of()));
    }

    @Test
    void robotThatItsClientLeaves_stopsInTheSameTick() {
        var client = client(POSITION2D, (self, frame) -> {
            if (frame.tick() == 1) {
                self.line.close();
            } else {
                self.drive(0, 0.5);
                self.answer(frame);
            }
        });
        ticks(3);
        assertThat(client.frames).hasSize(2);
        assertX(0, 0.05);
        assertThatThrownBy(() -> client.drive(0, 1)).isInstanceOf(ConnectionClosedException.class);
    }

    @Test
    void robotThatSomebodyElseStillDrives_doesNotStop() {
        var leaving = client(POSITION2D, WireClient.ANSWER);
        client(POSITION2D, (self, frame) -> {
            if (frame.tick() == 0) {
                self.drive(0, 0.5);
            }
            self.answer(frame);
        });
        simulation.tick();
        leaving.line.close();
        simulation.tick();
        assertX(0, 0.10);
    }

    @Test
    void closedSimulation_tellsItsClients_andTicksNoMore() throws Exception {
        var client = client(SONAR, WireClient.ANSWER);
        var threaded = new PlayerClient("localhost", PORT);
        threaded.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
        threaded.runThreaded(-1, -1);
        var promise = threaded.nextData();
        simulation.close();
        assertThat(client.losses).isNotEmpty().allMatch(reason -> reason.contains("closed"));
        assertThatThrownBy(simulation::tick).isInstanceOf(IllegalStateException.class);
        assertThatThrownBy(() -> client.line.answered(0)).isInstanceOf(ConnectionClosedException.class);
        assertThat(PlayerPorts.find(PORT)).isEmpty();
        threaded.join();
        assertThatThrownBy(() -> promise.get(Duration.ofSeconds(30))).isInstanceOf(PlayerException.class);
        assertThatThrownBy(() -> threaded.requestInterfaceSonar(0, PLAYER_OPEN_MODE))
                .isInstanceOf(PlayerException.class);
    }

    @Test
    void unansweredTick_namesTheClient_canBeRepeated_andTheWorldHasNotMoved() {
        var client = client(SONAR, (self, frame) -> {});
        simulation.answerLimit(Duration.ofMillis(1));
        assertThatThrownBy(simulation::tick)
                .isInstanceOf(UnansweredTickException.class)
                .hasMessageContainingAll("tick 0", "client 1 on port " + PORT + " (sonar:0)");
        assertThat(simulation.latest().tick()).isZero();
        client.line.answered(0);
        assertThat(simulation.tick().tick()).isEqualTo(1);
    }

    @Test
    void clientWithoutSubscription_isNotWaitedFor() {
        new PlayerClient("localhost", PORT);
        simulation.answerLimit(Duration.ofSeconds(30));
        assertThat(simulation.tick().tick()).isEqualTo(1);
    }

    // ---- programs on threads

    /** Runs a program on a separate thread until it ends or its server closes. */
    private static Thread program(Runnable code) {
        return Thread.ofPlatform().daemon().start(() -> {
            try {
                code.run();
            } catch (PlayerException serverHasGone) {
                // ends every endless program
            }
        });
    }

    private static void await(CountDownLatch latch) throws InterruptedException {
        assertThat(latch.await(30, TimeUnit.SECONDS)).isTrue();
    }

    @Test
    void busyProgram_stopsInFrontOfTheWall_andItsClampingHarmsNobody() throws Exception {
        simulation.close();
        simulation = open(0, wall("east", 4.1, 0, 0.2, 10, BLACK));
        var connected = new CountDownLatch(1);
        program(() -> {
            PlayerClient robot = new PlayerClient("localhost", PORT);
            Position2DInterface pos = robot.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
            SonarInterface son = robot.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
            robot.runThreaded(-1, -1);
            connected.countDown();
            while (true) {
                while (!son.isDataReady())
                    ;
                float[] ranges = son.getData().getRanges();
                for (int i = 0; i < son.getData().getRanges_count(); i++) {
                    ranges[i] = Math.min(ranges[i], 4f); // clamps the array in place
                }
                pos.setSpeed(ranges[1] > 1 ? 0.4 : 0, 0);
            }
        });
        await(connected);
        ticks(120);
        assertThat(reading(0).pose().x()).isBetween(2.9, 3.1);
        assertThat(reading(1).sonarM().get(1)).isCloseTo(4, within(1e-9));
    }

    @Test
    void odometry_isSetWhereTheRobotStands_andPowerIsOn() {
        var client = new PlayerClient("localhost", PORT);
        var pos = client.requestInterfacePosition2D(1, PLAYER_OPEN_MODE);
        var son = client.requestInterfaceSonar(1, PLAYER_OPEN_MODE);
        pos.setMotorPower(1);
        son.setSonarPower(1);
        pos.setOdometry(new PlayerPose2d(7, 8, 0));
        simulation.whileWaiting(
                () -> { // the client's part of the tick, on this thread
                    client.readAll();
                    client.readAll();
                    simulation.whileWaiting(() -> {});
                    client.close();
                });
        simulation.tick();
        assertThat(pos.getX()).as("before").isZero();
        assertThat(reading(1).odometry().pose())
                .extracting(pose -> pose.x(), pose -> pose.y())
                .containsExactly(7.0, 8.0);
    }

    @Test
    void missingDeviceOrServer_namesThoseThereAre_andAPortIsOpenedOnce() {
        var client = new PlayerClient("localhost", PORT);
        assertThatThrownBy(() -> client.requestInterfaceSonar(7, PLAYER_OPEN_MODE))
                .isInstanceOf(PlayerException.class)
                .hasMessage("[PlayerClient] Requested device sonar:7 is not in the device list. It has: position2d:0, "
                        + "sonar:0, blobfinder:0, position2d:1, sonar:1, blobfinder:1");
        client.close();
        assertThatThrownBy(() -> new PlayerClient("localhost", 6999))
                .isInstanceOf(PlayerException.class)
                .hasMessageContainingAll("localhost:6999", "" + PORT);
        assertThatThrownBy(() -> open(0, wall("east", 3, 0, 0.2, 1, RED)))
                .isInstanceOf(PlayerException.class)
                .hasMessageContaining("port " + PORT + " is in use");
    }

    // ---- actor spaces

    /** A space with a client of robot one, at 0.5 m/s. */
    private ActorSpace spaceWithAClient(String name) throws InterruptedException {
        var space = ActorSpace.create(SpaceSettings.named(name).withClock(simulation.clock()));
        var connected = new CountDownLatch(1);
        space.execute(() -> {
            var client = new PlayerClient("localhost", PORT);
            client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE).setSpeed(0.5, 0);
            connected.countDown();
        });
        await(connected);
        return space;
    }

    @Test
    void spaceThatDoesNotComeToAnEnd_isNamed() throws Exception {
        var release = new CountDownLatch(1);
        try (var space = spaceWithAClient("thinker")) {
            space.execute(() -> {
                try {
                    release.await();
                } catch (InterruptedException e) {
                    Thread.currentThread().interrupt();
                }
            });
            simulation.answerLimit(Duration.ofMillis(20));
            assertThatThrownBy(simulation::tick)
                    .isInstanceOf(UnansweredTickException.class)
                    .hasMessageContainingAll("position2d:0", "actor space thinker");
            release.countDown();
        }
    }

    @Test
    void spaceThatIsClosed_takesItsClientsWithIt() throws Exception {
        var space = spaceWithAClient("gone");
        simulation.tick();
        assertX(0, 0.05);
        space.close();
        ticks(2);
        assertThat(simulation.hasSubscribers()).isFalse();
        assertX(0, 0.05);
    }

    @Test
    void clientsOfOneSpace_getTheirFramesInOneTurn_inTheOrderTheyConnected() {
        var log = new ArrayList<String>();
        try (var space = ActorSpace.create(SpaceSettings.named("threadless").withoutThread())) {
            simulation.whileWaiting(space::runQueued);
            space.execute(() -> {
                for (int index = 1; index >= 0; index--) {
                    int robot = index;
                    var client = new PlayerClient("localhost", PORT);
                    client.requestInterfacePosition2D(robot, PLAYER_OPEN_MODE);
                    client.runThreaded(-1, -1);
                    client.nextData().then(ready -> {
                        log.add("robot " + robot);
                        space.execute(() -> log.add("what follows for " + robot));
                    });
                }
            });
            space.runQueued();
            simulation.tick();
        }
        assertThat(log).containsExactly("robot 1", "robot 0", "what follows for 1", "what follows for 0");
    }

    @Test
    void clientOnAnActorSpace_isToldByAPromise_andItsWholeTurnIsItsAnswer() throws Exception {
        var seen = new ArrayList<String>();
        var begun = new CountDownLatch(1);
        try (var space = ActorSpace.create(SpaceSettings.named("robots").withClock(simulation.clock()))) {
            space.execute(() -> {
                var robot = new PlayerClient("localhost", PORT);
                var pos = robot.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
                robot.runThreaded(-1, -1);
                Runnable look = () -> {
                    seen.add(pos.isDataReady() + " at " + simulation.clock().nanos() / 1_000_000);
                    // a chain of turns that all belong to this tick
                    space.execute(() -> space.execute(() -> pos.setSpeed(pos.getX() + 0.1, 0)));
                };
                space.repeatWhile(() -> true, () -> robot.nextData().thenAccept(ready -> look.run()))
                        .exceptionally(lost -> null);
            });
            space.onIdle(begun::countDown);
            await(begun);
            ticks(2);
            assertX(0, 0.01 + 0.011);
            assertThat(seen).containsExactly("true at 0", "true at 100");
        }
    }
}
