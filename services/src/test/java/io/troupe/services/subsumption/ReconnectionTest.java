package io.troupe.services.subsumption;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.actor.time.Clock;
import io.troupe.common.text.NamedColours;
import io.troupe.player.PlayerException;
import io.troupe.player.wire.DeviceCommand;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/** Tests a separate connection for each service, as in the paper, and what it costs. */
class ReconnectionTest {
    private static final DeviceCommand.Velocity STOP = new DeviceCommand.Velocity(0, 0, 0, true);

    private final TestSpace test = new TestSpace();
    private final FakeRobots robots = new FakeRobots(test, 2);
    private final RecordingServiceObserver charge = new RecordingServiceObserver();
    private final RobotServices services = test.spawn(
            RobotServices.class,
            () -> new RobotServicesActor(RobotServicesActor.Settings.ofThePaper()
                    .withPort(FakeRobots.PORT)
                    .withObserver(charge)
                    .withReconnection(true)));

    /**
     * Starts the first state with the arbitrator of a mode.
     *
     * @return the promise of the arbitrator's end
     */
    private Promise<?> begin(Mode mode) {
        var table = SubsumptionTable.ofThePaper();
        Arbitrator arbitrator =
                test.spawn(Arbitrator.class, () -> new Arbitrator(mode, services, table, (state, seenBy) -> {}));
        arbitrator.live();
        Promise<?> ended = arbitrator.failure();
        test.crank();
        return ended;
    }

    @AfterEach
    void nothingIsLeft() {
        test.close();
        robots.close();
        assertThat(robots.connections()).as("connections left open").isZero();
        assertThat(charge.most()).as("services of a robot at the same time").isLessThanOrEqualTo(1);
    }

    @ParameterizedTest
    @EnumSource(names = {"PROMISE", "CALLBACK"})
    void switchOfServices_leavesTheRobotsStandingWithoutAServiceUntilTheNextReading(Mode mode) {
        begin(mode);
        robots.show(1, NamedColours.RED);
        robots.tick(100);
        assertThat(charge.of(0)).isEmpty();
        assertThat(charge.of(1)).isEmpty();
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
        assertThat(robots.lastCommand(1)).isEqualTo(STOP);
        robots.tick(100);
        assertThat(charge.of(0)).containsExactly(Service.SPACE_WANDERER);
        assertThat(charge.of(1)).containsExactly(Service.WALL_FOLLOWER);
        assertThat(robots.lastCommand(0).vx()).isPositive();
        assertThat(robots.lastCommand(1).vx()).isPositive();
    }

    @ParameterizedTest
    @EnumSource(names = {"PROMISE", "CALLBACK"})
    void robotsThatSeeEachOthersColours_driveBetweenTheSwitches(Mode mode) {
        begin(mode);
        robots.show(1, NamedColours.RED);
        robots.show(0, NamedColours.BLUE);
        for (int i = 0; i < 10; i++) {
            robots.tick(100);
            assertThat(robots.lastCommand(0)).isEqualTo(STOP);
            robots.tick(100);
            assertThat(robots.lastCommand(0).vx()).isPositive();
            assertThat(robots.lastCommand(1).vx()).isPositive();
        }
    }

    @ParameterizedTest
    @EnumSource(names = {"PROMISE", "CALLBACK"})
    void everySwitch_makesNewConnections_andClosesTheOld(Mode mode) {
        begin(mode);
        assertThat(robots.connectionsMade()).isEqualTo(2);
        robots.show(1, NamedColours.RED);
        robots.show(0, NamedColours.BLUE);
        for (int switches = 1; switches <= 5; switches++) {
            robots.tick(100);
            assertThat(robots.connectionsMade()).isEqualTo(2 + 2 * switches);
            assertThat(robots.connections()).isEqualTo(2);
            robots.tick(100);
            assertThat(robots.connectionsMade()).isEqualTo(2 + 2 * switches);
        }
    }

    @ParameterizedTest
    @EnumSource(names = {"PROMISE", "CALLBACK"})
    void serverThatIsGoneAtTheSwitch_endsTheArbitrator(Mode mode) {
        Promise<?> ended = begin(mode);
        robots.show(1, NamedColours.RED);
        robots.refuse();
        robots.tick(100);
        assertThat(test.error(ended)).isInstanceOf(PlayerException.class).hasMessageContaining("no more clients");
        test.takeProblems();
    }

    @Test
    void synchronousMode_connectsOnce_andRefuses() {
        var settings = new SubsumptionRun.Settings(
                Mode.SYNC,
                "localhost",
                FakeRobots.PORT,
                SubsumptionTable.ofThePaper(),
                Clock.system(),
                ServiceObserver.NONE,
                (state, seenBy) -> {});
        assertThatThrownBy(() -> settings.withReconnection(true))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("sync")
                .hasMessageContaining("connects once");
    }

    @ParameterizedTest
    @EnumSource(names = {"PROMISE", "CALLBACK"})
    void secondService_whileTheFirstWaitsForItsFirstReading_isRefused(Mode mode) {
        begin(mode);
        robots.show(1, NamedColours.RED);
        robots.tick(100);
        var problem = test.error(services.drive(0, Service.SPACE_WANDERER.name(), NamedColours.RED));
        assertThat(problem).hasMessageContaining("robot 1 is in the charge of spaceWanderer");
        assertThat(charge.of(0)).isEmpty();
        robots.tick(100);
        assertThat(charge.of(0)).hasSize(1);
    }
}
