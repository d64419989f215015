package io.troupe.player;

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
import io.troupe.player.wire.DataSink;
import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.DeviceCommand.Velocity;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.Frame;
import io.troupe.player.wire.Interfaces;
import io.troupe.player.wire.PlayerConnection;
import io.troupe.sim.Simulation;
import io.troupe.sim.TestWorlds;
import io.troupe.sim.UnansweredTickException;
import io.troupe.sim.WorldSettings;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.function.BiConsumer;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/**
 * The definition of a tick, tested at the wire level: the client acts inside the delivery, so nothing depends on
 * threads.
 */
@Timeout(60)
class LockStepTest {
    private static final int PORT = 6760;

    private final Simulation simulation = Simulation.open(
            TestWorlds.scenario(
                    PORT,
                    TestWorlds.world(
                            List.of(robot("one", 0, 0, 0), robot("two", 0, 3, Math.PI)),
                            wall("east", 3, 0, 0.2, 1, RED))),
            WorldSettings.DEFAULT);

    @AfterEach
    void close() {
        simulation.close();
    }

    /** A client that reacts to every frame in the same way. */
    private final class Client implements DataSink {
        final List<Frame> frames = new ArrayList<>();
        final PlayerConnection connection = PlayerPorts.find(PORT).orElseThrow().connect(this, null);
        private final BiConsumer<Client, Frame> move;

        @Nullable
        String lost;

        Client(BiConsumer<Client, Frame> move, int robot, Interfaces... types) {
            this.move = move;
            for (var type : types) {
                connection.subscribe(device(type, robot));
            }
        }

        DeviceAddress device(Interfaces type, int robot) {
            return connection.devices().stream()
                    .filter(each -> each.interfaceCode() == type.code() && each.index() == robot)
                    .findFirst()
                    .orElseThrow();
        }

        void drive(int robot, double speedMps) {
            connection.command(device(Interfaces.POSITION2D, robot), new Velocity(speedMps, 0, 0, true));
        }

        @Override
        public void frame(Frame frame) {
            frames.add(frame);
            move.accept(this, frame);
        }

        @Override
        public void lost(String reason) {
            lost = reason;
        }
    }

    private double x(int robot) {
        return simulation.latest().robots().get(robot).pose().x();
    }

    @Test
    void command_beforeTheAnswer_countsForThisTick_afterItForTheNext() {
        var client = new Client(
                (self, frame) -> {
                    self.drive(0, 0.1);
                    self.connection.answered(frame.tick());
                    self.drive(0, 0.5);
                },
                0,
                Interfaces.POSITION2D);
        simulation.tick();
        assertThat(x(0)).isCloseTo(0.01, within(1e-9));
        client.drive(0, 0.2); // between two ticks: newer than the 0.5, and also after the answer
        simulation.tick();
        assertThat(x(0))
                .as("0.1 again, said in the delivery of the second tick")
                .isCloseTo(0.02, within(1e-9));
    }

    @Test
    void command_afterTheAnswer_countsForTheNextTick_ifNothingNewerIsSaid() {
        new Client(
                (self, frame) -> {
                    self.connection.answered(frame.tick());
                    if (frame.tick() == 0) {
                        self.drive(0, 0.5);
                    }
                },
                0,
                Interfaces.POSITION2D);
        simulation.tick();
        assertThat(x(0)).isZero();
        simulation.tick();
        assertThat(x(0)).isCloseTo(0.05, within(1e-9));
    }

    @Test
    void twoClientsOfOneRobot_theOneThatConnectedLastWins_whoeverSpeaksFirst() {
        var first = new Client((self, frame) -> {}, 0, Interfaces.POSITION2D);
        new Client(
                (self, frame) -> {
                    self.drive(0, 0.4);
                    self.connection.answered(frame.tick());
                    first.drive(0, 0.1);
                    first.connection.answered(frame.tick());
                },
                0,
                Interfaces.POSITION2D);
        simulation.tick();
        assertThat(x(0)).isCloseTo(0.04, within(1e-9));
    }

    @Test
    void frame_hasTheSubscribedDevicesOnly_inTheOrderOfRobotsAndDevices_inSimulatedTime() {
        var client = new Client((self, frame) -> self.connection.answered(frame.tick()), 1, Interfaces.BLOBFINDER);
        client.connection.subscribe(client.device(Interfaces.SONAR, 0));
        client.connection.subscribe(client.device(Interfaces.POSITION2D, 1));
        client.connection.subscribe(client.device(Interfaces.BLOBFINDER, 0));
        simulation.tick();
        simulation.tick();
        assertThat(client.frames.getLast().timeSeconds()).isEqualTo(0.1);
        assertThat(client.frames.getLast().messages())
                .allSatisfy(message -> assertThat(message.timeSeconds()).isEqualTo(0.1))
                .extracting(message -> Interfaces.name(message.from().interfaceCode()) + ":"
                        + message.from().index())
                .containsExactly("sonar:0", "blobfinder:0", "position2d:1", "blobfinder:1");
        var images = client.frames.getLast().messages().stream()
                .map(message -> message.data())
                .filter(DeviceData.Blobs.class::isInstance)
                .map(DeviceData.Blobs.class::cast)
                .toList();
        assertThat(images.getFirst().width()).as("sees the red wall").isEqualTo(80);
        assertThat(images.getLast()).as("sees nothing").isEqualTo(new DeviceData.Blobs(0, 0, List.of()));
    }

    @Test
    void robotThatItsClientLeaves_stopsInTheSameTick() {
        var client = new Client(
                (self, frame) -> {
                    if (frame.tick() == 1) {
                        self.connection.close();
                    } else {
                        self.drive(0, 0.5);
                        self.connection.answered(frame.tick());
                    }
                },
                0,
                Interfaces.POSITION2D);
        simulation.tick();
        simulation.tick();
        simulation.tick();
        assertThat(client.frames).hasSize(2);
        assertThat(x(0)).isCloseTo(0.05, within(1e-9));
        assertThatThrownBy(() -> client.drive(0, 1)).isInstanceOf(ConnectionClosedException.class);
    }

    @Test
    void robotThatSomebodyElseStillDrives_doesNotStop() {
        var leaving = new Client((self, frame) -> self.connection.answered(frame.tick()), 0, Interfaces.POSITION2D);
        new Client(
                (self, frame) -> {
                    if (frame.tick() == 0) {
                        self.drive(0, 0.5);
                    }
                    self.connection.answered(frame.tick());
                },
                0,
                Interfaces.POSITION2D);
        simulation.tick();
        leaving.connection.close();
        simulation.tick();
        assertThat(x(0)).isCloseTo(0.10, within(1e-9));
    }

    @Test
    void closedSimulation_tellsItsClients_andTicksNoMore() {
        var client = new Client((self, frame) -> self.connection.answered(frame.tick()), 0, Interfaces.SONAR);
        simulation.close();
        assertThat(client.lost).contains("closed");
        assertThatThrownBy(simulation::tick).isInstanceOf(IllegalStateException.class);
        assertThatThrownBy(() -> client.connection.answered(0)).isInstanceOf(ConnectionClosedException.class);
        assertThat(PlayerPorts.find(PORT)).isEmpty();
    }

    @Test
    void unansweredTick_canBeRepeated_andTheWorldHasNotMoved() {
        var client = new Client((self, frame) -> {}, 0, Interfaces.SONAR);
        simulation.answerLimit(Duration.ofMillis(1));
        assertThatThrownBy(simulation::tick)
                .isInstanceOf(UnansweredTickException.class)
                .hasMessageContaining("tick 0")
                .hasMessageContaining("sonar:0");
        assertThat(simulation.latest().tick()).isZero();
        client.connection.answered(0);
        assertThat(simulation.tick().tick()).isEqualTo(1);
    }

    @Test
    void odometry_isSetWhereTheRobotStands_andPowerIsOn() {
        var client = new PlayerClient("localhost", PORT);
        var pos = client.requestInterfacePosition2D(1, PlayerConstants.PLAYER_OPEN_MODE);
        var son = client.requestInterfaceSonar(1, PlayerConstants.PLAYER_OPEN_MODE);
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
        assertThat(simulation.latest().robots().get(1).odometry().pose().x()).isEqualTo(7);
        assertThat(simulation.latest().robots().get(1).odometry().pose().y()).isEqualTo(8);
    }

    // ---- actor spaces

    @Test
    void spaceThatDoesNotComeToAnEnd_isNamed() throws Exception {
        var release = new CountDownLatch(1);
        try (var space = ActorSpace.create(SpaceSettings.named("thinker").withClock(simulation.clock()))) {
            connectOn(space);
            space.execute(() -> awaitQuietly(release));
            simulation.answerLimit(Duration.ofMillis(20));
            assertThatThrownBy(simulation::tick)
                    .isInstanceOf(UnansweredTickException.class)
                    .hasMessageContaining("position2d:0")
                    .hasMessageContaining("actor space thinker");
            release.countDown();
        }
    }

    @Test
    void spaceThatIsClosed_takesItsClientsWithIt() throws Exception {
        var space = ActorSpace.create(SpaceSettings.named("gone").withClock(simulation.clock()));
        connectOn(space);
        simulation.tick();
        assertThat(x(0)).isCloseTo(0.05, within(1e-9));
        space.close();
        simulation.tick();
        simulation.tick();
        assertThat(simulation.hasSubscribers()).isFalse();
        assertThat(x(0)).isCloseTo(0.05, within(1e-9));
    }

    @Test
    void clientsOfOneSpace_getTheirFramesInOneTurn_inTheOrderTheyConnected() {
        var log = new ArrayList<String>();
        try (var space = ActorSpace.create(SpaceSettings.named("crank").withHandCrank())) {
            simulation.whileWaiting(space::crank);
            space.execute(() -> {
                for (int index = 1; index >= 0; index--) {
                    int robot = index;
                    var client = new PlayerClient("localhost", PORT);
                    client.requestInterfacePosition2D(robot, PlayerConstants.PLAYER_OPEN_MODE);
                    client.runThreaded(-1, -1);
                    client.nextData().then(ready -> {
                        log.add("robot " + robot);
                        space.execute(() -> log.add("what follows for " + robot));
                    });
                }
            });
            space.crank();
            simulation.tick();
        }
        assertThat(log).containsExactly("robot 1", "robot 0", "what follows for 1", "what follows for 0");
    }

    /** Connects a client of robot one on the space, at 0.5 m/s. */
    private static void connectOn(ActorSpace space) throws InterruptedException {
        var connected = new CountDownLatch(1);
        space.execute(() -> {
            var client = new PlayerClient("localhost", PORT);
            client.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE)
                    .setSpeed(0.5, 0);
            connected.countDown();
        });
        assertThat(connected.await(30, TimeUnit.SECONDS)).isTrue();
    }

    private static void awaitQuietly(CountDownLatch latch) {
        try {
            latch.await();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
