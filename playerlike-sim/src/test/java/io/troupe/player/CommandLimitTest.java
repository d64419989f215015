package io.troupe.player;

import static io.troupe.player.wire.Interfaces.POSITION2D;
import static io.troupe.sim.TestWorlds.robot;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.PlayerPose2d;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.sim.Replay;
import io.troupe.sim.Simulation;
import io.troupe.sim.Snapshot;
import io.troupe.sim.TestWorlds;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.WorldSpec;
import java.io.StringReader;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** Speeds with a time limit that each client requests for itself; a tick is 100 ms. */
class CommandLimitTest {
    private static final int PORT = 6796;
    private static final double FAST = 0.3;

    private Simulation simulation = open(WorldSettings.DEFAULT);

    private static WorldSpec world() {
        return TestWorlds.world(List.of(robot("one", 0, 0, 0), robot("two", 0, 3, 0)));
    }

    private static Simulation open(WorldSettings settings) {
        return Simulation.open(TestWorlds.scenario(PORT, world()), settings);
    }

    @AfterEach
    void close() {
        simulation.close();
    }

    /** A client that has both robots open and answers every tick; it sends only what the test requests. */
    private static WireClient client() {
        return new WireClient(PORT, WireClient.ANSWER).subscribe(POSITION2D, 0).subscribe(POSITION2D, 1);
    }

    private static WireClient limited(int millis) {
        var client = client();
        assertThat(client.ask(POSITION2D, 0, limit(millis))).isEqualTo(new DeviceReply.Ack());
        return client;
    }

    private static DeviceRequest limit(int millis) {
        return new DeviceRequest.SetIntegerProperty(DeviceRequest.COMMAND_LIMIT_KEY, millis);
    }

    private static void drive(WireClient client, int robot, double forwardMps) {
        client.tell(POSITION2D, robot, new DeviceCommand.Velocity(forwardMps, 0, 0, true));
    }

    private double speed(int robot) {
        return simulation.latest().robots().get(robot).odometry().forwardMps();
    }

    private double speedAfterTick(int robot) {
        simulation.tick();
        return speed(robot);
    }

    /** Number of ticks in which the robot still moves. */
    private int ticksUntilItStands(int robot) {
        for (int ticks = 0; ticks < 50; ticks++) {
            if (speedAfterTick(robot) == 0) {
                return ticks;
            }
        }
        throw new AssertionError("robot " + robot + " still drives after 5 s");
    }

    @Test
    void speed_holdsForItsLimit_fromTheIntervalInWhichItTookEffect() {
        var client = limited(400);
        drive(client, 0, FAST);
        assertThat(ticksUntilItStands(0)).isEqualTo(4);
        double stoodAt = simulation.latest().robots().get(0).pose().x();
        assertThat(stoodAt).isCloseTo(4 * 0.1 * FAST, org.assertj.core.api.Assertions.within(1e-6));
        simulation.tick();
        assertThat(simulation.latest().robots().get(0).pose().x()).isEqualTo(stoodAt);
    }

    @Test
    void speedThatComesAgainInTime_holdsOn_andTheNextOneAfterItsEndDrivesAgain() {
        var client = limited(400);
        for (int i = 0; i < 5; i++) {
            drive(client, 0, FAST);
            for (int tick = 0; tick < 4; tick++) {
                assertThat(speedAfterTick(0)).isEqualTo(FAST);
            }
        }
        assertThat(speedAfterTick(0)).isZero();
        drive(client, 0, FAST);
        assertThat(ticksUntilItStands(0)).isEqualTo(4);
    }

    @Test
    void headingAndCarCommands_expireToo_andAGoalDoesNot() {
        var client = limited(300);
        client.tell(POSITION2D, 0, new DeviceCommand.VelocityHeading(FAST, 1));
        assertThat(ticksUntilItStands(0)).isEqualTo(3);
        client.tell(POSITION2D, 0, new DeviceCommand.Car(FAST, 0));
        assertThat(ticksUntilItStands(0)).isEqualTo(3);
        client.tell(POSITION2D, 0, new DeviceCommand.GoTo(5, 5, 0, 0, 0, 0, true));
        for (int tick = 0; tick < 60; tick++) {
            simulation.tick();
        }
        assertThat(speed(0)).isPositive();
    }

    @Test
    void clientWithoutALimit_drivesOn_asPlayerHasIt_andALimitIsForOneDevice() {
        var client = limited(200);
        drive(client, 1, FAST);
        for (int tick = 0; tick < 50; tick++) {
            assertThat(speedAfterTick(1)).isEqualTo(FAST);
        }
        client.ask(POSITION2D, 0, limit(0));
        drive(client, 0, FAST);
        for (int tick = 0; tick < 50; tick++) {
            assertThat(speedAfterTick(0)).isEqualTo(FAST);
        }
    }

    @Test
    void limitShorterThanAnInterval_holdsForOne() {
        drive(limited(1), 0, FAST);
        assertThat(ticksUntilItStands(0)).isEqualTo(1);
    }

    @Test
    void endOfOneClientsSpeed_leavesTheNewerOneOfAnother() {
        var limited = limited(300);
        var other = client();
        drive(limited, 0, FAST);
        simulation.tick();
        drive(other, 0, 0.1);
        for (int tick = 0; tick < 50; tick++) {
            assertThat(speedAfterTick(0)).isEqualTo(0.1);
        }
        drive(limited, 0, FAST);
        assertThat(ticksUntilItStands(0)).as("the newest holds, and ends").isEqualTo(3);
    }

    @Test
    void clientThatLeavesWhileAnotherHasTheRobotOpen_drivesItNoLongerThanItsLimit() {
        var leaving = limited(400);
        var onlooker = client();
        drive(leaving, 0, FAST);
        leaving.line.close();
        assertThat(ticksUntilItStands(0)).isEqualTo(4);
        assertThat(onlooker.frames).isNotEmpty();
    }

    @Test
    void reset_forgetsTheSpeedAndItsEnd_andTheClientKeepsItsLimit() {
        var client = limited(300);
        drive(client, 0, FAST);
        simulation.tick();
        simulation.reset();
        assertThat(speedAfterTick(0)).isZero();
        simulation.world().command(0, 0.1, 0);
        for (int tick = 0; tick < 20; tick++) {
            assertThat(speedAfterTick(0)).isEqualTo(0.1);
        }
        drive(client, 0, FAST);
        assertThat(ticksUntilItStands(0)).isEqualTo(3);
    }

    @Test
    void motorsThatAreSwitchedOffAndOn_standStill_afterTheEndToo() {
        var client = limited(300);
        drive(client, 0, FAST);
        simulation.tick();
        client.ask(POSITION2D, 0, new DeviceRequest.Power(false));
        assertThat(speedAfterTick(0)).isZero();
        client.ask(POSITION2D, 0, new DeviceRequest.Power(true));
        for (int tick = 0; tick < 5; tick++) {
            assertThat(speedAfterTick(0)).isZero();
        }
    }

    @Test
    void recording_hasTheEndAsACommandToStand_andReplaysBitForBit() throws Exception {
        for (long watchdogMicros : new long[] {0, 700_000}) {
            simulation.close();
            var settings = WorldSettings.DEFAULT.withWatchdogMicros(watchdogMicros);
            simulation = open(settings);
            var out = new StringBuilder();
            List<Snapshot> recorded = new ArrayList<>();
            var recording = simulation.record(out);
            recorded.add(simulation.latest());
            var client = limited(300);
            for (int tick = 0; tick < 40; tick++) {
                if (tick % 8 == 1) {
                    drive(client, 0, FAST);
                } else if (tick == 20) {
                    client.tell(POSITION2D, 0, new DeviceCommand.VelocityHeading(0.2, 1));
                }
                recorded.add(simulation.tick());
            }
            recording.close();
            assertThat(out).contains("\n1 velocity 0 0.3 0.0\n4 velocity 0 0.0 0.0\n9 velocity 0 0.3 0.0\n");
            List<Snapshot> replayed = new ArrayList<>();
            Replay.read(new StringReader(out.toString())).play(world(), replayed::add);
            assertThat(replayed).isEqualTo(recorded);
        }
    }

    @Test
    void otherPropertiesAndNegativeLimits_areRefused() {
        var client = client();
        assertThat(client.ask(POSITION2D, 0, new DeviceRequest.SetIntegerProperty("gain", 3)))
                .isEqualTo(new DeviceReply.Nack(
                        "there is no property 'gain', expected " + DeviceRequest.COMMAND_LIMIT_KEY));
        assertThat(client.ask(POSITION2D, 0, limit(-1)))
                .isEqualTo(new DeviceReply.Nack(
                        DeviceRequest.COMMAND_LIMIT_KEY + " is -1, expected 0 (no limit) or more"));
        assertThat(client.ask(POSITION2D, 0, new DeviceRequest.Capability(3, 253)))
                .isEqualTo(new DeviceReply.Ack());
    }

    @Test
    void positionProxy_asksForIt() {
        var client = new PlayerClient("localhost", PORT);
        try {
            var wheels = client.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
            wheels.setCommandLimit(Duration.ofMillis(200));
            wheels.setSpeed(FAST, 0);
            simulation.lockStep(false);
            assertThat(ticksUntilItStands(0)).isEqualTo(2);
            wheels.setCommandLimit(Duration.ZERO);
            wheels.setVelocity(new PlayerPose2d(FAST, 0, 0), 1);
            for (int tick = 0; tick < 20; tick++) {
                assertThat(speedAfterTick(0)).isEqualTo(FAST);
            }
            for (Duration wrong : List.of(Duration.ofMillis(-1), Duration.ofNanos(1_500_000), Duration.ofDays(50))) {
                assertThatThrownBy(() -> wheels.setCommandLimit(wrong))
                        .isInstanceOf(PlayerException.class)
                        .hasMessageContaining("expected whole milliseconds, 0 or more");
            }
        } finally {
            client.close();
        }
    }
}
