package io.troupe.services.component.kinds;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.testkit.TestSpace;
import io.troupe.bus.Bus;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusSettings;
import io.troupe.common.text.NamedColours;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.component.ComponentInterface;
import io.troupe.services.component.ComponentState;
import io.troupe.services.component.RecordingObserver;
import io.troupe.services.subsumption.FakeRobots;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

class PlayerComponentTest {
    private static final DeviceCommand.Velocity STOP = new DeviceCommand.Velocity(0, 0, 0, true);

    private final TestSpace test = new TestSpace();
    private final FakeRobots robots = new FakeRobots(test, 2);
    private final Bus bus = Bus.inProcess("here", BusSettings.on(test.space()));
    private final RecordingObserver notes = new RecordingObserver();
    private final List<String> heard = new ArrayList<>();
    private final BusPort user = bus.attach("user");
    private ComponentInterface<?, ?> provider;

    @BeforeEach
    void twoRobots() {
        test.run(() -> provider = ComponentInterface.open(
                bus,
                "robots",
                PlayerComponent.of(new PlayerComponent.Settings("localhost", FakeRobots.PORT, List.of(1, 2), true)),
                notes));
    }

    @AfterEach
    void nothingIsLeft() {
        test.run(provider::close);
        bus.close();
        test.crank();
        assertThat(robots.connections()).as("connections left open").isZero();
        test.close();
        robots.close();
    }

    private void started() {
        test.get(provider.start().thenApply(runs -> true));
        notes.take();
    }

    private void drive(String robot, double forwardMps, double turnRadps) {
        test.run(() -> user.publish(RobotTopics.velocity(robot), new Velocity(forwardMps, turnRadps)));
    }

    @Test
    void robots_saySonarPositionAndBlobs_underTheirNames_andOnceForEachReading() {
        test.run(() -> {
            user.subscribe(
                    RobotTopics.sonar("robot1"),
                    (reading, from) -> heard.add("1 at " + reading.timeSeconds() + " sonar 3 "
                            + reading.rangesM().get(3)));
            user.subscribe(RobotTopics.position("robot2"), (reading, from) -> heard.add("2 at " + reading.xM()));
            user.subscribe(
                    RobotTopics.blobs("robot2"),
                    (reading, from) -> heard.add("2 sees " + reading.blobs().size() + ", the second "
                            + NamedColours.name(reading.blobs().get(1).colour())));
        });
        started();
        robots.range(0, 3, 1.5);
        robots.show(1, NamedColours.RED);
        robots.tick(100);
        assertThat(heard).containsExactlyInAnyOrder("1 at 0.1 sonar 3 1.5", "2 at 0.0", "2 sees 2, the second red");
        robots.tick(100);
        assertThat(heard).hasSize(6);
    }

    @Test
    void laser_isSubscribedToAndPublished_onlyIfTheSettingsSaySo() {
        robots.giveLaser(0);
        robots.giveLaser(1);
        List<RobotTopics.LaserReading> scans = new ArrayList<>();
        test.run(() -> user.subscribe(RobotTopics.laser("robot1"), (scan, from) -> scans.add(scan)));
        started();
        robots.tick(100);
        assertThat(robots.laserSubscriptions(0)).isZero();
        assertThat(scans).isEmpty();

        var settings = new PlayerComponent.Settings("localhost", FakeRobots.PORT, List.of(1), false, true);
        var withLaser = new ArrayList<ComponentInterface<?, ?>>();
        test.run(() -> withLaser.add(ComponentInterface.open(bus, "lasers", PlayerComponent.of(settings), notes)));
        test.get(withLaser.getFirst().start().thenApply(runs -> true));
        robots.tick(100);
        assertThat(robots.laserSubscriptions(0)).isOne();
        assertThat(robots.laserSubscriptions(1)).isZero();
        assertThat(scans).singleElement().satisfies(scan -> {
            assertThat(scan.timeSeconds()).isEqualTo(0.2);
            assertThat(scan.rangesM()).containsExactly(1.0, 2.0, 3.0);
            assertThat(scan.maxBearingRad()).isEqualTo((float) (Math.PI / 2));
            assertThat(scan.maxRangeM()).isEqualTo(8);
        });
        test.run(withLaser.getFirst()::close);
    }

    @Test
    void velocity_drivesTheRobotThatItIsFor() {
        started();
        drive("robot2", 0.3, -0.1);
        assertThat(robots.lastCommand(1)).isEqualTo(new DeviceCommand.Velocity(0.3, 0, -0.1, true));
        assertThat(robots.commands(0)).isEmpty();
    }

    @Test
    void velocityThatIsNoNumber_isRefusedByTheConversion() {
        started();
        drive("robot1", Double.NaN, 0);
        assertThat(robots.commands(0)).isEmpty();
        assertThat(notes.take()).hasSize(1).first().asString().contains("robot1/velocity", "expected finite numbers");
    }

    @Test
    void robotThatNobodyCommandsAnyMore_isStopped_andThisIsTold() {
        started();
        drive("robot1", 0.3, 0);
        for (int reading = 1; reading < PlayerComponent.MAX_READINGS_WITHOUT_COMMAND; reading++) {
            robots.tick(100);
        }
        assertThat(robots.commands(0)).hasSize(1);
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
        assertThat(notes.take()).containsExactly("robots robot 1 has heard no command for 5 readings, and is stopped");
        robots.tick(100);
        assertThat(robots.commands(0)).hasSize(2);
    }

    @Test
    void clockThatIsSetBackOrForward_leavesNoReadingUnsaid_andStillStopsARobotThatNobodyCommands() {
        test.run(() -> {
            user.subscribe(RobotTopics.sonar("robot1"), (reading, from) -> heard.add("sonar"));
            user.subscribe(RobotTopics.position("robot1"), (reading, from) -> heard.add("position"));
            user.subscribe(RobotTopics.blobs("robot1"), (reading, from) -> heard.add("blobs"));
        });
        started();
        robots.tick(100_000);
        for (int steppedMillis : new int[] {-60_000, 60_000}) {
            drive("robot1", 0.3, 0);
            heard.clear();
            robots.tick(steppedMillis);
            assertThat(heard).containsExactlyInAnyOrder("sonar", "position", "blobs");
            for (int reading = 1; reading < PlayerComponent.MAX_READINGS_WITHOUT_COMMAND; reading++) {
                robots.tick(100);
            }
            assertThat(robots.lastCommand(0))
                    .as("after a step of %s ms", steppedMillis)
                    .isEqualTo(STOP);
        }
    }

    @Test
    void robot_isStoppedByItsServerIfThisEnds_andASilentServerIsNoticed() {
        started();
        assertThat(robots.limits())
                .containsExactly(
                        "silence PT5S", "robot 1 troupe_command_limit_ms 400", "robot 2 troupe_command_limit_ms 400");
    }

    @Test
    void serverThatWasSilent_getsZeroSpeed_whenTheComponentFails() {
        started();
        drive("robot1", 0.3, 0);
        test.run(robots::vanish);
        assertThat(provider.state()).isEqualTo(ComponentState.FAILED);
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
    }

    @Test
    void termination_stopsTheRobots_andDisconnects() {
        started();
        drive("robot1", 0.3, 0);
        test.get(provider.stop().thenApply(ended -> true));
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
        assertThat(robots.connections()).isZero();
        test.get(provider.start().thenApply(runs -> true));
        assertThat(robots.connections()).isEqualTo(1);
    }

    @Test
    void lostServer_isNamedByTheHealth() {
        started();
        test.get(provider.check().thenApply(well -> true));
        test.run(robots::vanish);
        assertThat(provider.state()).isEqualTo(ComponentState.FAILED);
        assertThat(test.error(provider.check()))
                .hasMessage("here/robots has failed: Player server localhost:7001: the server has gone");
    }

    @Test
    void missingRobot_isNamedByTheStart() {
        test.run(provider::close);
        test.run(() -> provider = ComponentInterface.open(
                bus,
                "robots",
                PlayerComponent.of(new PlayerComponent.Settings("localhost", FakeRobots.PORT, List.of(3), true)),
                notes));
        assertThat(test.error(provider.start()))
                .hasMessageContaining("here/robots has failed")
                .hasMessageContaining("2");
    }
}
