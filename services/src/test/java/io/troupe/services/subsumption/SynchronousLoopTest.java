package io.troupe.services.subsumption;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.testkit.TestSpace;
import io.troupe.actor.time.Clock;
import io.troupe.common.text.NamedColours;
import io.troupe.player.PlayerException;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.services.behaviour.Senses;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Optional;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/** The synchronous mode, reading by reading. */
@Timeout(60)
class SynchronousLoopTest {
    private static final DeviceCommand.Velocity STOP = new DeviceCommand.Velocity(0, 0, 0, true);
    private static final Service WF = Service.WALL_FOLLOWER;
    private static final Service SW = Service.SPACE_WANDERER;

    private final TestSpace test = new TestSpace();
    private final FakeRobots robots = new FakeRobots(test, 2);
    private final RecordingServiceObserver charge = new RecordingServiceObserver();
    private final List<String> states = Collections.synchronizedList(new ArrayList<>());

    private final SubsumptionRun.Settings settings = new SubsumptionRun.Settings(
            Mode.SYNC,
            "localhost",
            FakeRobots.PORT,
            SubsumptionTable.ofThePaper(),
            Clock.system(),
            charge,
            (state, seenBy) -> states.add(state.number() + " by " + seenBy));

    @AfterEach
    void nothingIsLeft() {
        robots.close();
        test.close();
        assertThat(robots.connections()).as("connections left open").isZero();
        assertThat(charge.most()).as("services of a robot at the same time").isLessThanOrEqualTo(1);
        assertThat(charge.coloursSent()).as("messages").isZero();
    }

    private void assertCommands(int ofRobot1, int ofRobot2) {
        assertThat(robots.commands(0)).as("commands to robot 1").hasSize(ofRobot1);
        assertThat(robots.commands(1)).as("commands to robot 2").hasSize(ofRobot2);
    }

    @Test
    void services_takeTurns_oneAReading_onOneConnection() throws InterruptedException {
        try (var run = SubsumptionRun.start(settings)) {
            assertThat(robots.connections()).isOne();
            assertThat(charge.of(0)).containsExactly(WF);
            assertThat(charge.of(1)).containsExactly(SW);
            robots.tickAndAwait(100);
            assertCommands(1, 0);
            robots.tickAndAwait(100);
            assertCommands(1, 1);
            robots.tickAndAwait(100);
            assertCommands(2, 1);
            run.check();
        }
    }

    @Test
    void service_getsBlobsStallAndLaser_asInTheOtherModes() throws InterruptedException {
        robots.giveLaser(1);
        robots.stall(1);
        robots.show(1, NamedColours.RED);
        List<Senses> readings = Collections.synchronizedList(new ArrayList<>());
        var looking = new Service("looking", false, () -> senses -> {
                    readings.add(senses);
                    return Optional.empty();
                })
                .withLaser();
        var table = SubsumptionTable.forRobots(2)
                .when(NamedColours.BLUE, WF, looking)
                .allowFinal()
                .build();
        var settings = new SubsumptionRun.Settings(
                Mode.SYNC, "localhost", FakeRobots.PORT, table, Clock.system(), charge, (state, seenBy) -> {});
        try (var run = SubsumptionRun.start(settings)) {
            assertThat(robots.laserSubscriptions(0)).isZero();
            assertThat(robots.laserSubscriptions(1)).isOne();
            robots.tickAndAwait(100);
            robots.tickAndAwait(100);
            run.check();
        }
        assertThat(readings).singleElement().satisfies(senses -> {
            assertThat(senses.stalled()).isTrue();
            assertThat(senses.largestBlob(NamedColours.RED)).isPresent();
            assertThat(senses.laser().nearestM(-0.1, 0.1)).isEqualTo(2);
        });
    }

    @Test
    void services_waitForTheFirstScanOfASlowLaser() throws InterruptedException {
        robots.giveLaser(1);
        robots.setLaserSlow(1, true);
        List<Integer> sizes = Collections.synchronizedList(new ArrayList<>());
        var scanning = new Service("scanning", false, () -> senses -> {
                    sizes.add(senses.laser().size());
                    return Optional.empty();
                })
                .withLaser();
        var table = SubsumptionTable.forRobots(2)
                .when(NamedColours.BLUE, WF, scanning)
                .allowFinal()
                .build();
        var settings = new SubsumptionRun.Settings(
                Mode.SYNC, "localhost", FakeRobots.PORT, table, Clock.system(), charge, (state, seenBy) -> {});
        try (var run = SubsumptionRun.start(settings)) {
            robots.tickAndAwait(100);
            robots.tickAndAwait(100);
            assertCommands(0, 0);
            robots.setLaserSlow(1, false);
            robots.tickAndAwait(100);
            robots.tickAndAwait(100);
            run.check();
        }
        assertThat(sizes).containsExactly(3);
    }

    @Test
    void dataThatComeMoreOftenThanACycle_arePassedOver() throws InterruptedException {
        try (var run = SubsumptionRun.start(settings)) {
            for (int i = 0; i < 8; i++) {
                robots.tickAndAwait(50);
            }
            assertCommands(2, 2);
            run.check();
        }
    }

    @ParameterizedTest
    @EnumSource
    void clockThatIsSetBackOrForward_leavesNoRobotWithoutControl(SynchronousRound round) throws InterruptedException {
        try (var run = SubsumptionRun.start(settings.withRound(round))) {
            for (int steppedMillis : new int[] {-60_000, 60_000}) {
                for (int reading = 0; reading < 4; reading++) {
                    robots.tickAndAwait(100);
                }
                int before = robots.commands(0).size() + robots.commands(1).size();
                robots.tickAndAwait(steppedMillis);
                robots.tickAndAwait(100);
                robots.tickAndAwait(100);
                robots.tickAndAwait(100);
                int each = round == SynchronousRound.ALL_SERVICES_A_READING ? 2 : 1;
                assertThat(robots.commands(0).size() + robots.commands(1).size() - before)
                        .as("commands to both robots in the 4 readings from a step of %s ms on", steppedMillis)
                        .isGreaterThanOrEqualTo(4 * each);
            }
            run.check();
        }
    }

    @Test
    void robotWhoseTurnComesTooLate_getsItsSpeedAgain_andOneThatStandsDoesNot() throws InterruptedException {
        var standing = new Service("standing", true, () -> senses -> Optional.empty());
        var table = SubsumptionTable.forRobots(6)
                .when(NamedColours.BLUE, Assignment.everyRobot(SW).robots(6, 6, standing))
                .allowFinal()
                .build();
        try (var six = new FakeRobots(test, 6, FakeRobots.PORT + 1);
                var run = SubsumptionRun.start(new SubsumptionRun.Settings(
                        Mode.SYNC,
                        "localhost",
                        FakeRobots.PORT + 1,
                        table,
                        Clock.system(),
                        ServiceObserver.NONE,
                        settings.listener()))) {
            for (int reading = 0; reading < 12; reading++) {
                six.tickAndAwait(100);
            }
            run.check();
            assertThat(six.commands(0))
                    .as("by its turns at 0.1 and 0.7 s, and again at 0.3, 0.5, 0.9 and 1.1 s")
                    .hasSize(6)
                    .containsOnly(new DeviceCommand.Velocity(0.5, 0, 0, true));
            assertThat(six.commands(5)).as("by its turns at 0.6 and 1.2 s").containsExactly(STOP, STOP);
        }
    }

    @Test
    void eachRobot_isStoppedByItsServerIfThisEnds_andASilentServerIsNoticed() throws InterruptedException {
        try (var run = SubsumptionRun.start(settings)) {
            run.check();
            assertThat(robots.limits())
                    .containsExactly(
                            "silence PT5S",
                            "robot 1 troupe_command_limit_ms 400",
                            "robot 2 troupe_command_limit_ms 400");
        }
    }

    @Test
    void colour_changesTheStateInItsRobotsTurn_withoutAStop_andRobot1IsNext() throws InterruptedException {
        try (var run = SubsumptionRun.start(settings)) {
            robots.show(1, NamedColours.ORANGE, NamedColours.RED);
            robots.tickAndAwait(100);
            assertThat(states).containsExactly("1 by null");
            robots.tickAndAwait(100);
            assertThat(states).containsExactly("1 by null", "2 by 1");
            assertThat(charge.of(0)).containsExactly(SW);
            assertThat(charge.of(1)).containsExactly(WF);
            assertCommands(1, 1);
            robots.tickAndAwait(100);
            assertCommands(2, 1);
            assertThat(robots.commands(0)).doesNotContain(STOP);
            run.check();
        }
    }

    @Test
    void colourSeenByRobot1_beginsTheNextStateWithRobot1Again() throws InterruptedException {
        try (var run = SubsumptionRun.start(settings)) {
            robots.show(1, NamedColours.RED);
            robots.tickAndAwait(100);
            robots.tickAndAwait(100);
            assertThat(states).endsWith("2 by 1");
            robots.show(0, NamedColours.BLUE);
            robots.tickAndAwait(100);
            assertThat(states).endsWith("1 by 0");
            assertCommands(2, 1);
            robots.tickAndAwait(100);
            assertCommands(3, 2); // robot 2 waits longer than usual for its next cycle: its speed is sent again
            robots.tickAndAwait(100);
            assertCommands(3, 3);
            run.check();
        }
    }

    @Test
    void withAllServicesAReading_everyRobotIsCommanded_andTheNextStateTakesOverAtOnce() throws InterruptedException {
        try (var run = SubsumptionRun.start(settings.withRound(SynchronousRound.ALL_SERVICES_A_READING))) {
            robots.tickAndAwait(100);
            assertCommands(1, 1);
            robots.show(1, NamedColours.RED);
            robots.show(0, NamedColours.BLUE);
            robots.tickAndAwait(100);
            assertThat(states).containsExactly("1 by null", "2 by 1");
            assertThat(robots.lastCommand(0).vx()).isEqualTo(0.5);
            assertThat(robots.lastCommand(1).vx()).isEqualTo(0.2);
            robots.tickAndAwait(100);
            assertThat(states).endsWith("1 by 0");
            run.check();
        }
    }

    @Test
    void close_stopsBothRobots() throws InterruptedException {
        try (var run = SubsumptionRun.start(settings)) {
            robots.tickAndAwait(100);
            run.check();
        }
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
        assertThat(robots.lastCommand(1)).isEqualTo(STOP);
        assertThat(charge.of(0)).isEmpty();
        assertThat(charge.of(1)).isEmpty();
    }

    @Test
    void serverThatGoesAway_endsTheRun() throws InterruptedException {
        try (var run = SubsumptionRun.start(settings)) {
            robots.tickAndAwait(100);
            robots.vanish();
            robots.awaitNoConnection();
            assertThat(robots.lastCommand(0))
                    .as("to a server that may still listen")
                    .isEqualTo(STOP);
            assertThatThrownBy(run::check).isInstanceOf(PlayerException.class).hasMessage("the server has gone");
            assertThat(charge.of(0)).isEmpty();
        }
    }

    @Test
    void behaviourThatThrows_endsTheRun_andTheRobotsStand() throws InterruptedException {
        try (var run = SubsumptionRun.start(settings)) {
            robots.range(0, 3, Double.NaN);
            robots.tickAndAwait(100);
            assertThatThrownBy(run::check).hasMessageContaining("sonar 3 reads NaN");
            assertThat(robots.lastCommand(0)).isEqualTo(STOP);
            assertThat(robots.lastCommand(1)).isEqualTo(STOP);
        }
    }

    @Test
    void serverThatIsNotThere_isToldAtTheStart() {
        var nowhere = new SubsumptionRun.Settings(
                Mode.SYNC,
                "localhost",
                1,
                settings.table(),
                settings.clock(),
                settings.observer(),
                settings.listener());
        assertThatThrownBy(() -> SubsumptionRun.start(nowhere))
                .isInstanceOf(PlayerException.class)
                .hasMessageContaining("7001");
    }
}
