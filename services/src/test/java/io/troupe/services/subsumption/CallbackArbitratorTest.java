package io.troupe.services.subsumption;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.Callback;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.common.text.NamedColours;
import io.troupe.player.PlayerException;
import io.troupe.player.wire.DeviceCommand;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

/** The arbitrator in callback mode, with robot services that it calls through a broker. */
class CallbackArbitratorTest {
    private static final Service WF = Service.WALL_FOLLOWER;
    private static final Service SW = Service.SPACE_WANDERER;

    private final TestSpace test = new TestSpace();
    private final FakeRobots robots = new FakeRobots(test, 2);
    private final RecordingServiceObserver charge = new RecordingServiceObserver();
    private final List<String> events = new ArrayList<>();
    private final List<Throwable> failures = new ArrayList<>(); // that the broker reports
    private Arbitrator arbitrator;

    @BeforeEach
    void begin() {
        RobotServices services = published(RobotServicesActor.Settings.ofThePaper()
                .withPort(FakeRobots.PORT)
                .withObserver(charge));
        arbitrator = test.spawn(
                Arbitrator.class,
                () -> new Arbitrator(Mode.CALLBACK, services, SubsumptionTable.ofThePaper(), new Events()));
        arbitrator.live();
        test.crank();
    }

    private RobotServices published(RobotServicesActor.Settings settings) {
        return SubsumptionRun.publishAndConnect(test.space(), () -> new RobotServicesActor(settings), failures::add);
    }

    private final class Events implements Arbitrator.StateListener {
        @Override
        public void stateStarted(State state, @Nullable Integer seenBy) {
            events.add("state " + state.number() + " by " + seenBy);
        }

        @Override
        public void colourReceived(int robot, int colour) {
            events.add(robot + " " + NamedColours.name(colour));
        }

        @Override
        public void colourTooLate(int robot, int colour) {
            events.add("too late");
        }
    }

    @AfterEach
    void nothingIsLeft() {
        test.space().stop(arbitrator); // ends the calls that are under way
        test.crank();
        assertThat(failures).isEmpty();
        test.close();
        robots.close();
        assertThat(robots.connections()).as("connections left open").isZero();
        assertThat(charge.most()).as("services of a robot at the same time").isEqualTo(1);
    }

    private void tick() {
        robots.tick(100);
        assertThat(charge.of(0)).as("robot 1 between two readings").hasSize(1);
        assertThat(charge.of(1)).as("robot 2 between two readings").hasSize(1);
    }

    private void assertInCharge(Service first, Service second) {
        assertThat(List.of(charge.of(0).getFirst(), charge.of(1).getFirst())).containsExactly(first, second);
    }

    @Test
    void orangeAndTheStatesOwn_areSentAtEveryReading_andChangeNothing_blackIsNotSent() {
        robots.show(1, NamedColours.ORANGE, NamedColours.BLUE);
        tick();
        tick();
        assertThat(events).containsExactly("state 1 by null", "1 orange", "1 blue", "1 orange", "1 blue");
        assertInCharge(WF, SW);
        assertThat(robots.lastCommand(1).vx()).isPositive();
    }

    @Test
    void blackThatHasAState_leadsToIt() {
        var table = SubsumptionTable.forRobots(1)
                .when(NamedColours.BLUE, SW)
                .when(NamedColours.BLACK, SW)
                .build();
        RobotServices services = published(RobotServicesActor.Settings.ofThePaper()
                .withPort(FakeRobots.PORT)
                .withTable(table));
        List<Integer> states = new ArrayList<>();
        Arbitrator callback = test.spawn(
                Arbitrator.class,
                () -> new Arbitrator(Mode.CALLBACK, services, table, (state, seenBy) -> states.add(state.number())));
        callback.live();
        test.crank();
        robots.tick(100);
        assertThat(states).containsExactly(1, 2);
    }

    @Test
    void twoPatchesOfAColour_areOneMessage() {
        robots.show(1, NamedColours.ORANGE, NamedColours.ORANGE);
        tick();
        assertThat(events).containsExactly("state 1 by null", "1 orange");
    }

    @Test
    void red_swapsTheServices_betweenTwoReadings_afterZeroSpeed() {
        robots.show(1, NamedColours.RED);
        tick();
        assertInCharge(SW, WF);
        assertThat(events).containsExactly("state 1 by null", "1 red", "state 2 by 1");
        assertThat(robots.commands(0).get(1)).isEqualTo(new DeviceCommand.Velocity(0, 0, 0, true));
        assertThat(robots.commands(0)).hasSize(3);
        assertThat(robots.commands(1)).hasSize(3);
    }

    @Test
    void whatFollowsTheColourThatCounts_isTooLate() {
        robots.show(1, NamedColours.RED, NamedColours.GREEN);
        tick();
        assertThat(events).containsExactly("state 1 by null", "1 red", "1 green", "too late", "state 2 by 1");
        assertInCharge(SW, WF);
    }

    @Test
    void twoRobotsAtOnce_theOneWithTheLowerIndexCounts() {
        robots.show(1, NamedColours.GREEN);
        tick();
        robots.show(0, NamedColours.ORANGE, NamedColours.BLUE);
        robots.show(1, NamedColours.RED);
        tick();
        assertThat(events)
                .containsExactly(
                        "state 1 by null",
                        "1 green",
                        "state 3 by 1",
                        "0 orange",
                        "0 blue",
                        "1 red",
                        "too late",
                        "state 1 by 0");
        assertInCharge(WF, SW);
    }

    @Test
    void serviceThatRunsForHours_isNotLate() {
        tick();
        robots.tick(10 * 3_600_000);
        robots.show(1, NamedColours.RED);
        tick();
        assertInCharge(SW, WF);
    }

    @Test
    void failingService_endsTheArbitrator() {
        tick();
        robots.vanish();
        assertThat(test.error(arbitrator.failure()))
                .isInstanceOf(PlayerException.class)
                .hasMessage("the server has gone");
        assertThat(charge.of(0)).isEmpty();
        assertThat(charge.of(1)).isEmpty();
    }

    @Test
    void behaviourThatThrows_endsTheArbitrator_andItsRobotStands() {
        tick();
        Promise<?> ended = arbitrator.failure();
        robots.range(0, 3, Double.NaN);
        robots.tick(100);
        assertThat(test.error(ended)).hasMessageContaining("sonar 3 reads NaN");
        assertThat(robots.lastCommand(0)).isEqualTo(new DeviceCommand.Velocity(0, 0, 0, true));
    }

    @Test
    void arbitratorThatIsStopped_leavesNoRobotDriving() {
        tick();
        test.space().stop(arbitrator);
        test.crank();
        robots.tick(100);
        assertThat(charge.of(0)).isEmpty();
        assertThat(charge.of(1)).isEmpty();
        assertThat(robots.lastCommand(0)).isEqualTo(new DeviceCommand.Velocity(0, 0, 0, true));
        assertThat(robots.lastCommand(1)).isEqualTo(new DeviceCommand.Velocity(0, 0, 0, true));
    }

    /** Services that end at once, although nothing has stopped them. */
    static class Quitters extends Actor implements RobotServices {
        @Override
        public Promise<ServiceEnd> drive(int robot, String service, int stateColour) {
            throw new AssertionError("called in promise mode");
        }

        @Override
        public void drive(int robot, String service, Callback<ColourReport> reports) {
            reports.finish();
        }

        @Override
        public Promise<@Nullable Void> stop(int robot) {
            return Promise.done();
        }
    }

    @Test
    void serviceThatEndsUntold_endsTheArbitrator() {
        RobotServices quitters = test.spawn(RobotServices.class, Quitters::new);
        Arbitrator left = test.spawn(
                Arbitrator.class,
                () -> new Arbitrator(Mode.CALLBACK, quitters, SubsumptionTable.ofThePaper(), new Events()));
        left.live();
        assertThat(test.error(left.failure()))
                .isInstanceOf(IllegalStateException.class)
                .hasMessage("robot 1: wallFollower has ended in state 1 though nothing told it to");
    }
}
