package io.troupe.services.subsumption;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.testkit.TestSpace;
import io.troupe.common.text.NamedColours;
import io.troupe.player.PlayerException;
import io.troupe.services.behaviour.Velocity;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

/** The arbitrator in promise mode, with robot services that it calls through a broker. */
class ArbitratorTest {
    private static final Service WF = Service.WALL_FOLLOWER;
    private static final Service SW = Service.SPACE_WANDERER;

    private final TestSpace test = new TestSpace();
    private final FakeRobots robots = new FakeRobots(test, 2);
    private final RecordingServiceObserver charge = new RecordingServiceObserver();
    private final List<String> states = new ArrayList<>();
    private Arbitrator arbitrator;

    private static RobotServices published(TestSpace test, RobotServicesActor.Settings settings) {
        return SubsumptionRun.publishAndConnect(test.space(), () -> new RobotServicesActor(settings), failure -> {});
    }

    @BeforeEach
    void begin() {
        RobotServices services = published(
                test,
                RobotServicesActor.Settings.ofThePaper()
                        .withPort(FakeRobots.PORT)
                        .withObserver(charge));
        arbitrator = test.spawn(
                Arbitrator.class,
                () -> new Arbitrator(
                        Mode.PROMISE,
                        services,
                        SubsumptionTable.ofThePaper(),
                        (state, seenBy) -> states.add(state.number() + " by " + seenBy)));
        arbitrator.live();
        test.crank();
    }

    @AfterEach
    void nothingIsLeft() {
        test.space().stop(arbitrator); // ends the calls that are under way
        test.crank();
        test.close();
        robots.close();
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
    void begins_withState1() {
        tick();
        assertInCharge(WF, SW);
        assertThat(states).containsExactly("1 by null");
    }

    @Test
    void red_swapsTheServices_betweenTwoReadings() {
        robots.show(1, NamedColours.RED);
        tick();
        assertInCharge(SW, WF);
        assertThat(states).containsExactly("1 by null", "2 by 1");
    }

    @Test
    void wallFollower_doesNotSeeColours() {
        robots.show(0, NamedColours.RED);
        tick();
        assertInCharge(WF, SW);
    }

    @Test
    void allStates_inTurn_andBack() {
        robots.show(1, NamedColours.GREEN);
        tick();
        assertInCharge(SW, SW);
        robots.show(1, NamedColours.BLACK);
        robots.show(0, NamedColours.RED);
        tick();
        assertInCharge(SW, WF);
        robots.show(0, NamedColours.BLUE);
        tick();
        assertInCharge(WF, SW);
        assertThat(states).containsExactly("1 by null", "3 by 1", "2 by 0", "1 by 0");
    }

    @Test
    void twoColoursAtOnce_theRobotWithTheLowerIndexCounts_andOnlyOnce() {
        robots.show(1, NamedColours.GREEN);
        tick();
        robots.show(0, NamedColours.BLUE);
        robots.show(1, NamedColours.RED);
        tick();
        assertThat(states).containsExactly("1 by null", "3 by 1", "1 by 0");
        assertInCharge(WF, SW);
        tick(); // robot 2 still sees red, and wanders again
        assertThat(states).endsWith("2 by 1");
    }

    @Test
    void robotsThatSeeEachOthersColours_switchAtEveryReading_butKeepMoving() {
        robots.show(1, NamedColours.RED);
        robots.show(0, NamedColours.BLUE);
        for (int i = 0; i < 10; i++) {
            tick();
            assertThat(robots.lastCommand(0).vx()).isPositive();
            assertThat(robots.lastCommand(1).vx()).isPositive();
        }
        assertThat(states).hasSize(11);
    }

    @Test
    void manySwitches_neverLeaveARobotWithoutAService() {
        int[] colours = {
            NamedColours.BLUE, NamedColours.RED, NamedColours.GREEN, NamedColours.ORANGE, NamedColours.BLACK
        };
        var random = new java.util.Random(20260);
        for (int i = 0; i < 2_000; i++) {
            robots.show(0, colours[random.nextInt(colours.length)]);
            robots.show(1, colours[random.nextInt(colours.length)]);
            tick();
        }
        assertThat(states).hasSizeGreaterThan(500);
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
        assertThat(test.error(arbitrator.failure())).isInstanceOf(PlayerException.class);
        test.takeProblems();
    }

    @Test
    void arbitratorThatIsStopped_leavesNoRobotDriving() {
        tick();
        test.space().stop(arbitrator);
        test.crank();
        robots.tick(100);
        assertThat(charge.of(0)).isEmpty();
        assertThat(charge.of(1)).isEmpty();
        assertThat(robots.lastCommand(0).vx()).isZero();
        assertThat(robots.lastCommand(1).vx()).isZero();
    }

    @Test
    void colourThatLeadsNowhere_leavesTheRobotItsService() {
        var table = SubsumptionTable.forRobots(2)
                .when(NamedColours.BLUE, WF, SW)
                .when(NamedColours.RED, SW, WF)
                .build();
        var book = new RecordingServiceObserver();
        try (var other = new TestSpace();
                var others = new FakeRobots(other, 2, FakeRobots.PORT + 1)) {
            RobotServices services = published(
                    other,
                    RobotServicesActor.Settings.ofThePaper()
                            .withPort(FakeRobots.PORT + 1)
                            .withTable(table)
                            .withObserver(book));
            Arbitrator partial = other.spawn(
                    Arbitrator.class, () -> new Arbitrator(Mode.PROMISE, services, table, (state, seenBy) -> {}));
            partial.live();
            other.crank();
            others.show(1, NamedColours.GREEN);
            others.tick(100);
            assertThat(book.of(1)).containsExactly(SW);
            others.tick(100);
            assertThat(book.of(1)).containsExactly(SW);
            assertThat(others.lastCommand(1).vx()).isPositive();
            other.space().stop(partial);
            other.crank();
        }
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
        var book = new RecordingServiceObserver();
        try (var other = new TestSpace();
                var others = new FakeRobots(other, 1, FakeRobots.PORT + 1)) {
            RobotServices services = published(
                    other,
                    RobotServicesActor.Settings.ofThePaper()
                            .withPort(FakeRobots.PORT + 1)
                            .withTable(table)
                            .withObserver(book));
            Arbitrator own = other.spawn(
                    Arbitrator.class, () -> new Arbitrator(Mode.PROMISE, services, table, (state, seenBy) -> {}));
            own.live();
            other.crank();
            assertThat(book.of(0)).extracting(Service::name).containsExactly("spin");
            others.range(0, 3, 1.5);
            others.tick(100);
            assertThat(others.lastCommand(0).va()).isEqualTo(1.5);
            others.show(0, NamedColours.BLUE);
            others.tick(100);
            assertThat(book.of(0)).containsExactly(WF);
            assertThat(others.lastCommand(0).vx()).isPositive();
            other.space().stop(own);
            other.crank();
        }
    }
}
