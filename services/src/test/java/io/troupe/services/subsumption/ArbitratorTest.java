package io.troupe.services.subsumption;

import static io.troupe.common.text.NamedColours.BLACK;
import static io.troupe.common.text.NamedColours.BLUE;
import static io.troupe.common.text.NamedColours.GREEN;
import static io.troupe.common.text.NamedColours.ORANGE;
import static io.troupe.common.text.NamedColours.RED;
import static io.troupe.services.subsumption.FakeRobots.STOP;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import io.troupe.player.PlayerException;
import io.troupe.services.behaviour.Velocity;
import java.nio.file.Path;
import java.util.Optional;
import java.util.Random;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/** The arbitrator in promise and in callback mode, with robot services that it calls through a broker. */
class ArbitratorTest extends RobotsBench {
    private static final SubsumptionTable PAPER = SubsumptionTable.ofThePaper();

    private Arbitrator arbitrator;
    private LeasedRobots services;
    private int mostServices = 1; // of a robot at the same time

    private void begin(Mode mode, SubsumptionTable table, LeasedRobots leased) {
        begin(mode, table, leased, new Events());
    }

    private void begin(Mode mode, SubsumptionTable table, LeasedRobots leased, Arbitrator.StateListener listener) {
        services = leased;
        arbitrator = test.spawn(Arbitrator.class, () -> new Arbitrator(mode, services, table, listener));
        arbitrator.live();
        test.runQueued();
    }

    private void begin(Mode mode) {
        begin(mode, PAPER, published(PAPER));
    }

    @AfterEach
    void callsAreEnded() {
        test.space().stop(arbitrator);
        test.runQueued();
        assertThat(charge.most).as("services of a robot at the same time").isEqualTo(mostServices);
    }

    private void tick() {
        robots.tick(100);
        assertThat(charge.of(0)).as("robot 1 between two readings").hasSize(1);
        assertThat(charge.of(1)).as("robot 2 between two readings").hasSize(1);
    }

    // ---- both modes

    @ParameterizedTest
    @EnumSource(names = {"PROMISE", "CALLBACK"})
    void serviceThatRunsForHours_isNotLate(Mode mode) {
        begin(mode);
        tick();
        robots.tick(10 * 3_600_000);
        robots.show(1, RED);
        tick();
        assertInCharge(SW, WF);
    }

    @ParameterizedTest
    @EnumSource(names = {"PROMISE", "CALLBACK"})
    void failingService_endsTheArbitrator(Mode mode) {
        begin(mode);
        tick();
        robots.vanish();
        assertThat(test.error(arbitrator.failure()))
                .isInstanceOf(PlayerException.class)
                .hasMessage("the server has gone");
        assertThat(charge.of(0)).isEmpty();
        assertThat(charge.of(1)).isEmpty();
    }

    @ParameterizedTest
    @EnumSource(names = {"PROMISE", "CALLBACK"})
    void arbitratorThatIsStopped_leavesNoRobotDriving(Mode mode) {
        begin(mode);
        tick();
        test.space().stop(arbitrator);
        test.runQueued();
        robots.tick(100);
        assertThat(charge.of(0)).isEmpty();
        assertThat(charge.of(1)).isEmpty();
        assertLastCommands(STOP, STOP);
    }

    // ---- promise mode

    @Test
    void red_swapsTheServices_betweenTwoReadings() {
        begin(Mode.PROMISE);
        robots.show(1, RED);
        tick();
        assertInCharge(SW, WF);
        assertThat(states()).containsExactly("1 by null", "2 by 1");
    }

    @Test
    void allStates_inTurn_andBack() {
        begin(Mode.PROMISE);
        robots.show(0, RED); // a wall follower sees no colours
        tick();
        assertInCharge(WF, SW);
        assertThat(states()).containsExactly("1 by null");
        robots.show(0);
        robots.show(1, GREEN);
        tick();
        assertInCharge(SW, SW);
        robots.show(1, BLACK);
        robots.show(0, RED);
        tick();
        assertInCharge(SW, WF);
        robots.show(0, BLUE);
        tick();
        assertInCharge(WF, SW);
        assertThat(states()).containsExactly("1 by null", "3 by 1", "2 by 0", "1 by 0");
    }

    @Test
    void twoColoursAtOnce_theRobotWithTheLowerIndexCounts_andOnlyOnce() {
        begin(Mode.PROMISE);
        robots.show(1, GREEN);
        tick();
        robots.show(0, BLUE);
        robots.show(1, RED);
        tick();
        assertThat(states()).containsExactly("1 by null", "3 by 1", "1 by 0");
        assertInCharge(WF, SW);
        tick(); // robot 2 still sees red, and wanders again
        assertThat(states()).endsWith("2 by 1");
    }

    @Test
    void robotsThatSeeEachOthersColours_switchAtEveryReading_butKeepMoving() {
        begin(Mode.PROMISE);
        robots.show(1, RED);
        robots.show(0, BLUE);
        for (int i = 0; i < 10; i++) {
            tick();
            assertThat(robots.lastCommand(0).vx()).isPositive();
            assertThat(robots.lastCommand(1).vx()).isPositive();
        }
        assertThat(states()).hasSize(11);
    }

    @Test
    void manySwitches_neverLeaveARobotWithoutAService() {
        begin(Mode.PROMISE);
        int[] colours = {BLUE, RED, GREEN, ORANGE, BLACK};
        var random = new Random(20260);
        for (int i = 0; i < 2_000; i++) {
            robots.show(0, colours[random.nextInt(colours.length)]);
            robots.show(1, colours[random.nextInt(colours.length)]);
            tick();
        }
        assertThat(states()).hasSizeGreaterThan(500);
    }

    @Test
    void colourThatLeadsNowhere_leavesTheRobotItsService() {
        var table = SubsumptionTable.forRobots(2)
                .state(BLUE, WF, SW)
                .state(RED, SW, WF)
                .build();
        begin(Mode.PROMISE, table, published(table));
        robots.show(1, GREEN);
        for (int reading = 0; reading < 2; reading++) {
            robots.tick(100);
            assertThat(charge.of(1)).containsExactly(SW);
        }
        assertThat(robots.lastCommand(1).vx()).isPositive();
    }

    @Test
    void newService_plugsInByBeingNamedInTheTable() {
        var spin = new ServiceCatalogue.Kind(
                "spin",
                true,
                false,
                arguments -> () ->
                        senses -> Optional.of(new Velocity(0, senses.sonar().frontM())));
        var table = SubsumptionTableReader.parse(
                "robots 1\nstate red : spin\nstate blue : wallFollower\nallow final",
                Path.of("named"),
                ServiceCatalogue.standard().with(spin));
        begin(Mode.PROMISE, table, published(table));
        assertThat(charge.of(0)).extracting(Service::name).containsExactly("spin");
        robots.range(0, 3, 1.5);
        robots.tick(100);
        assertThat(robots.lastCommand(0).va()).isEqualTo(1.5);
        robots.show(0, BLUE);
        robots.tick(100);
        assertThat(charge.of(0)).containsExactly(WF);
        assertThat(robots.lastCommand(0).vx()).isPositive();
    }

    // ---- callback mode

    @Test
    void redInCallbackMode_swapsTheServices_betweenTwoReadings_afterZeroSpeed() {
        begin(Mode.CALLBACK);
        robots.show(1, RED);
        tick();
        assertInCharge(SW, WF);
        assertThat(events).containsExactly("state 1 by null", "1 red", "state 2 by 1");
        assertThat(robots.commands(0)).hasSize(3);
        assertThat(robots.commands(0).get(1)).isEqualTo(STOP);
        assertThat(robots.commands(1)).hasSize(3);
    }

    @Test
    void orangeAndTheStatesOwn_areSentAtEveryReading_andChangeNothing_blackIsNotSent() {
        begin(Mode.CALLBACK);
        robots.show(0, RED); // a wall follower sees no colours
        robots.show(1, ORANGE, BLUE);
        tick();
        tick();
        assertThat(events).containsExactly("state 1 by null", "1 orange", "1 blue", "1 orange", "1 blue");
        assertInCharge(WF, SW);
        assertThat(robots.lastCommand(1).vx()).isPositive();
    }

    @Test
    void blackThatHasAState_leadsToIt() {
        var table =
                SubsumptionTable.forRobots(1).state(BLUE, SW).state(BLACK, SW).build();
        begin(Mode.CALLBACK, table, published(table));
        robots.tick(100);
        assertThat(states()).containsExactly("1 by null", "2 by 0");
    }

    @Test
    void twoPatchesOfAColour_areOneMessage_andWhatFollowsTheColourThatCountsIsTooLate() {
        begin(Mode.CALLBACK);
        robots.show(1, ORANGE, ORANGE);
        tick();
        assertThat(String.join(", ", events)).isEqualTo("state 1 by null, 1 orange");
        robots.show(1, RED, GREEN);
        tick();
        assertThat(String.join(", ", events))
                .isEqualTo("state 1 by null, 1 orange, 1 red, 1 green, too late, state 2 by 1");
        assertInCharge(SW, WF);
    }

    @Test
    void twoRobotsAtOnce_theOneWithTheLowerIndexCounts() {
        begin(Mode.CALLBACK);
        robots.show(1, GREEN);
        tick();
        robots.show(0, ORANGE, BLUE);
        robots.show(1, RED);
        tick();
        assertThat(String.join(", ", events))
                .isEqualTo("state 1 by null, 1 green, state 3 by 1, 0 orange, 0 blue, 1 red, too late, state 1 by 0");
        assertInCharge(WF, SW);
    }

    @Test
    void behaviourThatThrows_endsTheArbitrator_andItsRobotStands() {
        begin(Mode.CALLBACK);
        tick();
        Promise<?> ended = arbitrator.failure();
        robots.range(0, 3, Double.NaN);
        robots.tick(100);
        assertThat(test.error(ended)).hasMessageContaining("sonar 3 reads NaN");
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
    }

    @Test
    void serviceThatEndsUntold_endsTheArbitrator() {
        mostServices = 0;
        begin(Mode.CALLBACK, PAPER, LeasedRobots.of(test.spawn(RobotServices.class, () -> new SilentServices() {
            @Override
            public Promise<ServiceEnd> report(Lease lease, int robot, String service, Callback<ColourReport> reports) {
                return Promise.of(new ServiceEnd(Optional.empty(), false));
            }
        })));
        assertThat(test.error(arbitrator.failure()))
                .isInstanceOf(IllegalStateException.class)
                .hasMessage("robot 1: wallFollower has ended in state 1 without having been stopped");
    }

    // ---- a separate connection for each service, as in the paper, and what it costs

    private void beginWithReconnection(Mode mode) {
        var settings = settings(PAPER).withReconnection(true);
        var actor = test.spawn(RobotServices.class, () -> new RobotServicesActor(settings));
        begin(mode, PAPER, LeasedRobots.of(actor), (state, seenBy) -> {});
        robots.show(1, RED);
    }

    @ParameterizedTest
    @EnumSource(names = {"PROMISE", "CALLBACK"})
    void switchOfServices_leavesTheRobotsStandingWithoutAServiceUntilTheNextReading(Mode mode) {
        beginWithReconnection(mode);
        robots.tick(100);
        assertThat(charge.of(0)).isEmpty();
        assertThat(charge.of(1)).isEmpty();
        assertLastCommands(STOP, STOP);
        var problem = test.error(call(() -> services.drive(0, SW.name(), RED)));
        assertThat(problem).hasMessageContaining("robot 1 is in the charge of spaceWanderer");
        assertThat(charge.of(0)).isEmpty();
        robots.tick(100);
        assertInCharge(SW, WF);
        assertThat(robots.lastCommand(0).vx()).isPositive();
        assertThat(robots.lastCommand(1).vx()).isPositive();
    }

    @ParameterizedTest
    @EnumSource(names = {"PROMISE", "CALLBACK"})
    void everySwitch_makesNewConnections_andClosesTheOld_theRobotsDriveBetweenThem(Mode mode) {
        beginWithReconnection(mode);
        assertThat(robots.connectionsMade).isEqualTo(2);
        robots.show(1, RED, GREEN); // green comes too late, and is ignored
        robots.show(0, BLUE);
        for (int switches = 1; switches <= 10; switches++) {
            robots.tick(100);
            assertThat(robots.lastCommand(0)).isEqualTo(STOP);
            assertThat(robots.connectionsMade).isEqualTo(2 + 2 * switches);
            assertThat(robots.connections()).isEqualTo(2);
            robots.tick(100);
            assertThat(robots.lastCommand(0).vx()).isPositive();
            assertThat(robots.lastCommand(1).vx()).isPositive();
            assertThat(robots.connectionsMade).isEqualTo(2 + 2 * switches);
        }
    }

    @ParameterizedTest
    @EnumSource(names = {"PROMISE", "CALLBACK"})
    void serverThatIsGoneAtTheSwitch_endsTheArbitrator(Mode mode) {
        beginWithReconnection(mode);
        Promise<?> ended = arbitrator.failure();
        robots.refuses = true;
        robots.tick(100);
        assertThat(test.error(ended)).isInstanceOf(PlayerException.class).hasMessageContaining("no more clients");
    }
}
