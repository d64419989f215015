package io.troupe.services.subsumption;

import static io.troupe.common.text.NamedColours.BLUE;
import static io.troupe.common.text.NamedColours.GREEN;
import static io.troupe.common.text.NamedColours.ORANGE;
import static io.troupe.common.text.NamedColours.RED;
import static io.troupe.services.subsumption.FakeRobots.STOP;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.Callback;
import io.troupe.actor.Clock;
import io.troupe.actor.Promise;
import io.troupe.player.PlayerException;
import io.troupe.services.behaviour.Senses;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.function.Supplier;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/**
 * The synchronous mode, reading by reading; and failures of the robot services in callback mode, where a call has no
 * promise that could be rejected.
 */
@Timeout(60)
class SubsumptionRunTest extends RobotsBench {
    private static final SubsumptionTable PAPER = SubsumptionTable.ofThePaper();

    private final SubsumptionRun.Settings settings = run(Mode.SYNC, FakeRobots.PORT, PAPER);

    @AfterEach
    void noColourIsSent() {
        assertThat(charge.coloursSent).as("messages").isZero();
    }

    // ---- callback mode

    private void runCallbacks(Supplier<? extends RobotServices> provider) throws InterruptedException {
        try (var run = SubsumptionRun.start(run(Mode.CALLBACK, FakeRobots.PORT, PAPER), provider)) {
            run.check();
        }
    }

    @Test
    void servicesThatAnswerNothing_areNoFailure() throws InterruptedException {
        List<String> driven = new CopyOnWriteArrayList<>();
        runCallbacks(() -> new SilentServices() {
            @Override
            public Promise<ServiceEnd> report(Lease lease, int robot, String service, Callback<ColourReport> reports) {
                driven.add(robot + " " + service);
                return super.report(lease, robot, service, reports);
            }
        });
        assertThat(driven).containsExactly("0 wallFollower", "1 spaceWanderer");
    }

    @Test
    void servicesThatEndOrCannotStart_areAFailureOfTheRun() {
        assertThatThrownBy(() -> runCallbacks(() -> new SilentServices() {
                    @Override
                    public Promise<ServiceEnd> report(
                            Lease lease, int robot, String service, Callback<ColourReport> reports) {
                        if (robot == 1) { // the last call
                            context().stop();
                        }
                        return super.report(lease, robot, service, reports);
                    }
                }))
                .hasMessageContaining("robotServices");
        assertThatThrownBy(() -> runCallbacks(() -> {
                    throw new IllegalStateException("no robots");
                }))
                .hasStackTraceContaining("no robots");
    }

    @Test
    void callThatReachesNoServices_isRejected_andTheStartIsAFailure() {
        var robots = LeasedRobots.of(SubsumptionRun.publishAndConnect(
                        test.space(),
                        PAPER,
                        () -> {
                            throw new IllegalStateException("no robots");
                        },
                        failures::add)
                .actors());
        Promise<?> end =
                call(() -> robots.report(0, "wallFollower", report -> {}).thenApply(stopped -> null));
        assertThat(failures).hasSize(2).allSatisfy(each -> assertThat(each).hasStackTraceContaining("no robots"));
        failures.clear();
        test.advance(Duration.ofSeconds(5));
        assertThat(test.error(end)).asString().contains("report", "found no provider");
        assertThat(test.takeProblems()).hasSize(2); // of the starts, one for each service of the table
    }

    // ---- synchronous mode

    private void ticks(int... millis) throws InterruptedException {
        for (int each : millis) {
            robots.tickAndAwait(each);
        }
    }

    private void assertCommands(int ofRobot1, int ofRobot2) {
        assertThat(robots.commands(0)).as("commands to robot 1").hasSize(ofRobot1);
        assertThat(robots.commands(1)).as("commands to robot 2").hasSize(ofRobot2);
    }

    @Test
    void services_takeTurns_oneAReading_onOneConnection_andCloseStopsBothRobots() throws InterruptedException {
        try (var run = SubsumptionRun.start(settings)) {
            assertThat(robots.connections()).isOne();
            String limit = " troupe_command_limit_ms 400";
            String age = " troupe_command_age_ms 300";
            assertThat(robots.limits)
                    .containsExactly(
                            "silence PT5S", "robot 1" + limit, "robot 1" + age, "robot 2" + limit, "robot 2" + age);
            assertInCharge(WF, SW);
            ticks(100);
            assertCommands(1, 0);
            ticks(100);
            assertCommands(1, 1);
            ticks(100);
            assertCommands(2, 1);
            run.check();
        }
        assertLastCommands(STOP, STOP);
        assertThat(charge.of(0)).isEmpty();
        assertThat(charge.of(1)).isEmpty();
    }

    private final List<Senses> readings = Collections.synchronizedList(new ArrayList<>());
    private final Service scanning = new Service("scanning", false, () -> senses -> {
                readings.add(senses);
                return Optional.empty();
            })
            .withLaser();

    @Test
    void service_waitsForTheFirstScanOfASlowLaser_andGetsBlobsStallAndLaser_asInTheOtherModes() throws Exception {
        robots.get(1).hasLaser = true;
        robots.get(1).isLaserSlow = true;
        robots.get(1).isStalled = true;
        robots.show(1, RED);
        try (var run = SubsumptionRun.start(run(Mode.SYNC, FakeRobots.PORT, table(WF, scanning)))) {
            assertThat(robots.laserSubscriptions(0)).isZero();
            assertThat(robots.laserSubscriptions(1)).isOne();
            ticks(100, 100);
            assertCommands(0, 0);
            robots.get(1).isLaserSlow = false;
            ticks(100, 100);
            run.check();
        }
        assertThat(readings).singleElement().satisfies(senses -> {
            assertThat(senses.stalled()).isTrue();
            assertThat(senses.largestBlob(RED)).isPresent();
            assertThat(senses.laser().size()).isEqualTo(3);
            assertThat(senses.laser().nearestM(-0.1, 0.1)).isEqualTo(2);
        });
    }

    @Test
    void dataThatComeMoreOftenThanACycle_arePassedOver() throws InterruptedException {
        try (var run = SubsumptionRun.start(settings)) {
            ticks(50, 50, 50, 50, 50, 50, 50, 50);
            assertCommands(2, 2);
            run.check();
        }
    }

    @ParameterizedTest
    @EnumSource
    void clockThatIsSetBackOrForward_leavesNoRobotWithoutControl(SynchronousRound round) throws InterruptedException {
        int each = round == SynchronousRound.ALL_SERVICES_A_READING ? 2 : 1;
        try (var run = SubsumptionRun.start(settings.withRound(round))) {
            for (int steppedMillis : new int[] {-60_000, 60_000}) {
                ticks(100, 100, 100, 100);
                int before = robots.commands(0).size() + robots.commands(1).size();
                ticks(steppedMillis, 100, 100, 100);
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
        var table = table(SW, SW, SW, SW, SW, standing);
        try (var six = new FakeRobots(test, 6, FakeRobots.PORT + 1);
                var run = SubsumptionRun.start(run(Mode.SYNC, FakeRobots.PORT + 1, table))) {
            for (int reading = 0; reading < 12; reading++) {
                six.tickAndAwait(100);
            }
            run.check();
            assertThat(six.commands(0))
                    .as("by its turns at 0.1 and 0.7 s, and again at 0.3, 0.5, 0.9 and 1.1 s")
                    .hasSize(6)
                    .containsOnly(WANDERER_AHEAD);
            assertThat(six.commands(5)).as("by its turns at 0.6 and 1.2 s").containsExactly(STOP, STOP);
        }
    }

    @Test
    void colour_changesTheStateInItsRobotsTurn_withoutAStop_andRobot1IsNext() throws InterruptedException {
        try (var run = SubsumptionRun.start(settings)) {
            robots.show(0, GREEN); // a wall follower sees no colours
            robots.show(1, ORANGE, RED);
            ticks(100);
            assertThat(states()).containsExactly("1 by null");
            ticks(100);
            assertThat(states()).containsExactly("1 by null", "2 by 1");
            assertInCharge(SW, WF);
            assertCommands(1, 1);
            robots.show(0, BLUE);
            ticks(100);
            assertThat(states()).endsWith("1 by 0");
            assertCommands(2, 1);
            ticks(100);
            assertCommands(3, 2); // robot 2 waits longer than usual for its next cycle: its speed is sent again
            ticks(100);
            assertCommands(3, 3);
            assertThat(robots.commands(0)).doesNotContain(STOP);
            run.check();
        }
    }

    @Test
    void withAllServicesAReading_everyRobotIsCommanded_andTheNextStateTakesOverAtOnce() throws InterruptedException {
        try (var run = SubsumptionRun.start(settings.withRound(SynchronousRound.ALL_SERVICES_A_READING))) {
            ticks(100);
            assertCommands(1, 1);
            robots.show(1, RED);
            robots.show(0, BLUE);
            ticks(100);
            assertThat(states()).containsExactly("1 by null", "2 by 1");
            assertThat(robots.lastCommand(0).vx()).isEqualTo(0.5);
            assertThat(robots.lastCommand(1).vx()).isEqualTo(0.2);
            ticks(100);
            assertThat(states()).endsWith("1 by 0");
            run.check();
        }
    }

    @Test
    void serverThatGoesAway_endsTheRun() throws InterruptedException {
        try (var run = SubsumptionRun.start(settings)) {
            ticks(100);
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
            ticks(100);
            assertThatThrownBy(run::check).hasMessageContaining("sonar 3 reads NaN");
            assertLastCommands(STOP, STOP);
        }
    }

    @Test
    void serverThatIsNotThere_isToldAtTheStart_andReconnectionIsRefused() {
        assertThatThrownBy(() -> SubsumptionRun.start(run(Mode.SYNC, 1, PAPER)))
                .isInstanceOf(PlayerException.class)
                .hasMessageContaining("7001");
        var anew = settings.robots().withReconnection(true);
        assertThatThrownBy(() -> SubsumptionRun.Settings.defaults()
                        .withMode(Mode.SYNC)
                        .withRobots(anew)
                        .withClock(Clock.system())
                        .withListener(settings.listener()))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContainingAll("sync", "connects once");
    }
}
