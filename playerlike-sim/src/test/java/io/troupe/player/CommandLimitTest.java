package io.troupe.player;

import static io.troupe.player.wire.Interfaces.POSITION2D;
import static io.troupe.sim.TestWorlds.robot;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

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
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Speeds with a time limit that each client requests for itself; a tick is 100 ms. */
class CommandLimitTest {
    private static final int PORT = 6796;
    private static final double FAST = 0.3;
    private static final String KEY = DeviceRequest.COMMAND_LIMIT_KEY;

    private Simulation simulation = open(WorldSettings.defaults());

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
        assertThat(limit(client, millis)).isEqualTo(new DeviceReply.Ack());
        return client;
    }

    private static DeviceReply limit(WireClient client, int millis) {
        return client.ask(POSITION2D, 0, new DeviceRequest.SetIntegerProperty(KEY, millis));
    }

    private double speedAfterTick(int robot) {
        return simulation.tick().robots().get(robot).odometry().forwardMps();
    }

    private void assertSpeed(int robot, double speedMps, int ticks) {
        for (int tick = 0; tick < ticks; tick++) {
            assertThat(speedAfterTick(robot)).isEqualTo(speedMps);
        }
    }

    /** The robot still moves in so many ticks, and then no more. */
    private void assertStandsAfter(int ticks) {
        int moving = 0;
        while (moving < 50 && speedAfterTick(0) != 0) {
            moving++;
        }
        assertThat(moving).as("ticks until it stands").isEqualTo(ticks);
    }

    private double x() {
        return simulation.latest().robots().getFirst().pose().x();
    }

    @Test
    void speed_holdsForItsLimit_fromTheIntervalInWhichItTookEffect() {
        limited(400).drive(0, FAST);
        assertStandsAfter(4);
        double stoodAt = x();
        assertThat(stoodAt).isCloseTo(4 * 0.1 * FAST, within(1e-6));
        simulation.tick();
        assertThat(x()).isEqualTo(stoodAt);
    }

    @Test
    void limitShorterThanAnInterval_holdsForOne() {
        limited(1).drive(0, FAST);
        assertStandsAfter(1);
    }

    @Test
    void speedThatComesAgainInTime_holdsOn_andTheNextOneAfterItsEndDrivesAgain() {
        var client = limited(400);
        for (int i = 0; i < 5; i++) {
            client.drive(0, FAST);
            assertSpeed(0, FAST, 4);
        }
        assertSpeed(0, 0, 1);
        client.drive(0, FAST);
        assertStandsAfter(4);
    }

    @Test
    void headingAndCarCommands_expireToo_andAGoalDoesNot() {
        var client = limited(300);
        client.tell(POSITION2D, 0, new DeviceCommand.VelocityHeading(FAST, 1));
        assertStandsAfter(3);
        client.tell(POSITION2D, 0, new DeviceCommand.Car(FAST, 0));
        assertStandsAfter(3);
        client.tell(POSITION2D, 0, new DeviceCommand.GoTo(5, 5, 0, 0, 0, 0, true));
        for (int tick = 0; tick < 59; tick++) {
            simulation.tick();
        }
        assertThat(speedAfterTick(0)).isPositive();
    }

    @Test
    void clientWithoutALimit_drivesOn_asPlayerHasIt_andALimitIsForOneDevice() {
        var client = limited(200);
        client.drive(1, FAST);
        assertSpeed(1, FAST, 50);
        limit(client, 0);
        client.drive(0, FAST);
        assertSpeed(0, FAST, 50);
    }

    @Test
    void endOfOneClientsSpeed_leavesTheNewerOneOfAnother() {
        var limited = limited(300);
        var other = client();
        limited.drive(0, FAST);
        simulation.tick();
        other.drive(0, 0.1);
        assertSpeed(0, 0.1, 50);
        limited.drive(0, FAST);
        assertStandsAfter(3); // the newest holds, and ends
    }

    @Test
    void clientThatLeavesWhileAnotherHasTheRobotOpen_drivesItNoLongerThanItsLimit() {
        var leaving = limited(400);
        var onlooker = client();
        leaving.drive(0, FAST);
        leaving.line.close();
        assertStandsAfter(4);
        assertThat(onlooker.frames).isNotEmpty();
    }

    @Test
    void reset_forgetsTheSpeedAndItsEnd_andTheClientKeepsItsLimit() {
        var client = limited(300);
        client.drive(0, FAST);
        simulation.tick();
        simulation.reset();
        assertSpeed(0, 0, 1);
        simulation.world().command(0, 0.1, 0);
        assertSpeed(0, 0.1, 20);
        client.drive(0, FAST);
        assertStandsAfter(3);
    }

    @Test
    void motorsThatAreSwitchedOffAndOn_standStill_afterTheEndToo() {
        var client = limited(300);
        client.drive(0, FAST);
        simulation.tick();
        client.ask(POSITION2D, 0, new DeviceRequest.Power(false));
        assertSpeed(0, 0, 1);
        client.ask(POSITION2D, 0, new DeviceRequest.Power(true));
        assertSpeed(0, 0, 5);
    }

    @ParameterizedTest
    @ValueSource(longs = {0, 700_000})
    void recording_hasTheEndAsACommandToStand_andReplaysBitForBit(long watchdogMicros) throws Exception {
        simulation.close();
        simulation = open(WorldSettings.defaults().withWatchdogMicros(watchdogMicros));
        var out = new StringBuilder();
        List<Snapshot> recorded = new ArrayList<>();
        var recording = simulation.record(out);
        recorded.add(simulation.latest());
        var client = limited(300);
        for (int tick = 0; tick < 40; tick++) {
            if (tick % 8 == 1) {
                client.drive(0, FAST);
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

    @Test
    void otherPropertiesAndNegativeLimits_areRefused() {
        var client = client();
        assertThat(client.ask(POSITION2D, 0, new DeviceRequest.SetIntegerProperty("gain", 3)))
                .isEqualTo(new DeviceReply.Nack(
                        "there is no property 'gain', expected " + KEY + " or troupe_command_age_ms"));
        assertThat(limit(client, -1)).isEqualTo(new DeviceReply.Nack(KEY + " is -1, expected 0 (no limit) or more"));
        assertThat(client.ask(POSITION2D, 0, new DeviceRequest.Capability(3, 253)))
                .isEqualTo(new DeviceReply.Ack());
    }

    @Test
    void positionProxy_asksForIt() {
        var client = new PlayerClient("localhost", PORT);
        var wheels = client.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
        wheels.setCommandLimit(Duration.ofMillis(200));
        wheels.setSpeed(FAST, 0);
        simulation.lockStep(false);
        assertStandsAfter(2);
        wheels.setCommandLimit(Duration.ZERO);
        wheels.setVelocity(new PlayerPose2d(FAST, 0, 0), 1);
        assertSpeed(0, FAST, 20);
        for (Duration wrong : List.of(Duration.ofMillis(-1), Duration.ofNanos(1_500_000), Duration.ofDays(50))) {
            assertThatThrownBy(() -> wheels.setCommandLimit(wrong))
                    .isInstanceOf(PlayerException.class)
                    .hasMessageContaining("expected whole milliseconds, 0 or more");
        }
        client.close();
    }
}
