package io.troupe.services.subsumption;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.common.text.NamedColours;
import io.troupe.player.PlayerException;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.services.subsumption.RobotServices.ServiceEnd;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.logging.Handler;
import java.util.logging.LogRecord;
import java.util.logging.Logger;
import java.util.logging.SimpleFormatter;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

class RobotServicesTest {
    private static final DeviceCommand.Velocity STOP = new DeviceCommand.Velocity(0, 0, 0, true);
    private static final DeviceCommand.Velocity FOLLOWER_AHEAD = new DeviceCommand.Velocity(0.2, 0, 0, true);
    private static final DeviceCommand.Velocity WANDERER_AHEAD = new DeviceCommand.Velocity(0.5, 0, 0, true);

    private final TestSpace test = new TestSpace();
    private final FakeRobots robots = new FakeRobots(test, 2);
    private final RecordingServiceObserver charge = new RecordingServiceObserver();
    private final RobotServices services = test.spawn(
            RobotServices.class,
            () -> new RobotServicesActor(RobotServicesActor.Settings.ofThePaper()
                    .withPort(FakeRobots.PORT)
                    .withObserver(charge)));

    @AfterEach
    void nothingIsLeft() {
        test.close();
        robots.close();
        assertThat(robots.connections()).as("connections left open").isZero();
        assertThat(charge.most()).as("services of a robot at the same time").isLessThanOrEqualTo(1);
    }

    private Promise<ServiceEnd> wallFollower(int robot) {
        return services.drive(robot, Service.WALL_FOLLOWER.name(), NamedColours.BLUE);
    }

    private Promise<ServiceEnd> wanderer(int robot, int stateColour) {
        return services.drive(robot, Service.SPACE_WANDERER.name(), stateColour);
    }

    private static ServiceEnd saw(int colour) {
        return new ServiceEnd(Optional.of(colour));
    }

    @Test
    void wallFollower_drivesByItsLaw_untilItIsStopped() {
        Promise<ServiceEnd> ended = wallFollower(0);
        test.crank();
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(FOLLOWER_AHEAD);
        robots.range(0, 3, 0.3);
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(new DeviceCommand.Velocity(0, 0, -0.45, true));
        assertThat(ended.isDone()).isFalse();
        services.stop(0);
        test.crank();
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
        assertThat(test.get(ended).colour()).isEmpty();
        assertThat(robots.commands(0)).hasSize(3);
    }

    @Test
    void stop_isNoticedWithoutWaitingForTheNextReading() {
        wallFollower(0);
        test.crank();
        robots.tick(100);
        test.get(services.stop(0));
        assertThat(charge.of(0)).isEmpty();
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
        test.get(services.stop(0)); // a second stop has no effect
        assertThat(robots.commands(0)).hasSize(2);
    }

    @Test
    void stop_ofARobotWithoutAService_isDoneAtOnce() {
        test.get(services.stop(1));
        assertThat(robots.connections()).isZero();
    }

    @Test
    void callThatIsCancelledWhileItIsQueued_hasNoEffect() {
        Promise<ServiceEnd> queued = wallFollower(0);
        queued.cancel();
        test.crank();
        robots.tick(100);
        assertThat(robots.connections()).isZero();
        assertThat(charge.of(0)).isEmpty();
    }

    @Test
    void serviceThatTheTableDoesNotHave_isRefused_andTheOthersAreNamed() {
        assertThat(test.error(services.drive(0, "wallFolower", NamedColours.BLUE)))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("there is no service wallFolower, expected one of wallFollower, spaceWanderer");
        var reports = new ArrayList<String>();
        Listener listener = test.spawn(Listener.class, () -> new Listener(services, "wallFolower", reports));
        listener.listen();
        test.crank();
        assertThat(reports)
                .containsExactly("there is no service wallFolower, expected one of wallFollower, spaceWanderer");
    }

    @Test
    void wanderer_endsItselfAtAColour_andSendsItOnce() {
        Promise<ServiceEnd> end = wanderer(1, NamedColours.BLUE);
        test.crank();
        robots.tick(100);
        assertThat(robots.lastCommand(1)).isEqualTo(WANDERER_AHEAD);
        robots.show(1, NamedColours.GREEN);
        robots.tick(100);
        assertThat(test.get(end)).isEqualTo(saw(NamedColours.GREEN));
        assertThat(robots.commands(1)).containsExactly(WANDERER_AHEAD, STOP);
        assertThat(charge.of(1)).isEmpty();
    }

    @Test
    void wanderer_ignoresBlackOrangeOtherColoursAndTheStatesOwn() {
        Promise<ServiceEnd> end = wanderer(0, NamedColours.BLUE);
        for (int ignored : new int[] {NamedColours.BLACK, NamedColours.ORANGE, 0x123456, NamedColours.BLUE}) {
            robots.show(0, ignored);
            robots.tick(100);
            assertThat(end.isDone()).as(NamedColours.name(ignored)).isFalse();
        }
        robots.show(0, NamedColours.RED);
        robots.tick(100);
        assertThat(test.get(end)).isEqualTo(saw(NamedColours.RED));
    }

    @Test
    void wanderer_inAStateThatTheTableDoesNotHave_endsAtEveryColourThatHasAState() {
        Promise<ServiceEnd> end = wanderer(0, 0x123456);
        for (int colour : new int[] {NamedColours.BLACK, NamedColours.ORANGE, 0x123456, NamedColours.BLUE}) {
            assertThat(end.isDone()).isFalse();
            robots.show(0, colour);
            robots.tick(100);
        }
        assertThat(test.get(end)).isEqualTo(saw(NamedColours.BLUE));
    }

    @Test
    void serviceWithoutColourFinder_seesNothing() {
        Promise<ServiceEnd> end = wallFollower(0);
        robots.show(0, NamedColours.RED);
        robots.tick(100);
        robots.tick(100);
        assertThat(end.isDone()).isFalse();
    }

    @Test
    void wanderer_stoppedBeforeItSawAnything_answersNoColour() {
        Promise<ServiceEnd> end = wanderer(0, NamedColours.GREEN);
        test.crank();
        services.stop(0);
        assertThat(test.get(end).colour()).isEmpty();
    }

    @Test
    void clockThatIsSetBackOrForward_leavesNoReadingWithoutACommand() {
        wallFollower(0);
        test.crank();
        for (int millis : new int[] {100, 100, -60_000, 100, 100, 60_000, 100, -150, 100, -60_000}) {
            int before = robots.commands(0).size();
            robots.tick(millis);
            assertThat(robots.commands(0))
                    .as("commands after a step of %s ms", millis)
                    .hasSize(before + 1);
        }
    }

    /** A pause of three readings is shorter than the command limit. */
    @Test
    void clockThatIsSetBackByLessThanACycle_goesOnWhenThatIsMadeUpFor() {
        wallFollower(0);
        test.crank();
        robots.tick(100);
        int before = robots.commands(0).size();
        for (int millis : new int[] {-50, 100}) {
            robots.tick(millis);
            assertThat(robots.commands(0)).hasSize(before);
        }
        robots.tick(100);
        assertThat(robots.commands(0)).hasSize(before + 1);
    }

    @Test
    void behaviour_seesATimeThatGoesOn_whenTheClockIsSetBack() {
        List<Double> times = new ArrayList<>();
        var clock = new Service("clock", false, () -> senses -> {
            times.add(senses.timeSeconds());
            return Optional.empty();
        });
        withTable(SubsumptionTable.forRobots(1)
                        .when(NamedColours.BLUE, clock)
                        .allowFinal()
                        .build())
                .drive(0, "clock", NamedColours.BLUE);
        test.crank();
        for (int millis : new int[] {100_000, 100, -60_000, 100}) {
            robots.tick(millis);
        }
        assertThat(times)
                .usingComparatorForType((a, b) -> Math.abs(a - b) < 1e-9 ? 0 : Double.compare(a, b), Double.class)
                .containsExactly(100.0, 100.1, 100.2, 100.3);
    }

    @Test
    void hold_countsOn_whenTheClockIsSetBack() {
        Promise<ServiceEnd> end = withTable(SubsumptionTable.forRobots(1)
                        .when(NamedColours.BLUE, Service.SPACE_WANDERER)
                        .when(NamedColours.RED, Service.SPACE_WANDERER)
                        .hold(0.25)
                        .build())
                .drive(0, Service.SPACE_WANDERER.name(), NamedColours.BLUE);
        test.crank();
        robots.show(0, NamedColours.RED);
        for (int millis : new int[] {100_000, 100, -60_000}) {
            robots.tick(millis);
            assertThat(end.isDone()).isFalse();
        }
        robots.tick(100);
        assertThat(test.get(end)).isEqualTo(saw(NamedColours.RED));
    }

    @Test
    void reports_countTheTimeInCharge_alsoWhenTheClockIsSetBack() {
        List<Double> inCharge = new ArrayList<>();
        test.run(() -> services.drive(0, Service.SPACE_WANDERER.name(), (report, error) -> {
            if (report != null) {
                inCharge.add(report.secondsInCharge());
            }
        }));
        robots.show(0, NamedColours.RED);
        for (int millis : new int[] {100_000, 100, -60_000, 100}) {
            robots.tick(millis);
        }
        assertThat(inCharge)
                .hasSize(4)
                .isSorted()
                .allSatisfy(seconds -> assertThat(seconds).isBetween(0.0, 0.35));
    }

    private RobotServices withTable(SubsumptionTable table) {
        return withTable(table, new ArrayList<>());
    }

    /** @param actors receives the actor itself, for calls that are no messages */
    private RobotServices withTable(SubsumptionTable table, List<RobotServicesActor> actors) {
        return test.spawn(RobotServices.class, () -> {
            actors.add(new RobotServicesActor(RobotServicesActor.Settings.ofThePaper()
                    .withPort(FakeRobots.PORT)
                    .withTable(table)));
            return actors.getFirst();
        });
    }

    @Test
    void robot_isStoppedByItsServerIfItsServiceEnds_andASilentServerIsNoticed() {
        wallFollower(1);
        test.crank();
        assertThat(robots.limits()).containsExactly("silence PT5S", "robot 2 troupe_command_limit_ms 400");
    }

    @Test
    void cycle_takesAHundredMilliseconds_howeverOftenDataCome() {
        wallFollower(0);
        test.crank();
        for (int i = 0; i < 10; i++) {
            robots.tick(50);
        }
        assertThat(robots.commands(0)).hasSize(5);
    }

    @Test
    void secondService_whileTheFirstIsNotStopped_isRefused() {
        wallFollower(0);
        Throwable error = test.error(wanderer(0, NamedColours.BLUE));
        assertThat(error)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("robot 1 is in the charge of wallFollower")
                .hasMessageContaining("stop the first before");
    }

    @Test
    void secondService_beginsWhenTheFirstHasStopped() {
        wallFollower(0);
        test.crank();
        robots.tick(100);
        services.stop(0);
        wanderer(0, NamedColours.BLUE);
        test.crank();
        assertThat(charge.of(0)).containsExactly(Service.SPACE_WANDERER);
        assertThat(robots.commands(0)).containsExactly(FOLLOWER_AHEAD, STOP, WANDERER_AHEAD);
        robots.tick(100);
        assertThat(robots.commands(0)).hasSize(4);
    }

    @Test
    void stop_alsoStopsAServiceThatStillWaitsForThePreviousOne() {
        var actors = new ArrayList<RobotServicesActor>();
        RobotServices own = withTable(SubsumptionTable.ofThePaper(), actors);
        own.drive(0, Service.WALL_FOLLOWER.name(), NamedColours.BLUE);
        test.crank();
        robots.tick(100);
        var waiting = new ArrayList<Promise<ServiceEnd>>();
        test.run(
                () -> { // in one turn, in which the first service cannot end
                    RobotServicesActor actor = actors.getFirst();
                    actor.stop(0);
                    waiting.add(actor.drive(0, Service.SPACE_WANDERER.name(), NamedColours.BLUE));
                    actor.stop(0);
                });
        assertThat(test.get(waiting.getFirst()).colour()).isEmpty();
        robots.tick(100);
        assertThat(robots.commands(0)).containsExactly(FOLLOWER_AHEAD, STOP);
        own.drive(0, Service.SPACE_WANDERER.name(), NamedColours.BLUE);
        test.crank();
        assertThat(robots.lastCommand(0)).isEqualTo(WANDERER_AHEAD);
    }

    @Test
    void stop_duringACycle_isNotForgotten() {
        var actors = new ArrayList<RobotServicesActor>();
        var stopping = new Service("stopping", false, () -> senses -> {
            actors.getFirst().stop(0);
            return Optional.empty();
        });
        var table = SubsumptionTable.forRobots(1)
                .when(NamedColours.BLUE, stopping)
                .allowFinal()
                .build();
        Promise<ServiceEnd> end = withTable(table, actors).drive(0, "stopping", NamedColours.BLUE);
        test.crank();
        robots.tick(100);
        assertThat(end.isDone()).isTrue();
    }

    @Test
    void serviceThatFailsWhileItTakesOver_rejectsItsPromiseAndFreesTheRobot() {
        wallFollower(0);
        test.crank();
        robots.tick(100);
        robots.range(0, 3, Double.NaN);
        services.stop(0);
        test.crank();
        robots.show(0, NamedColours.BLACK);
        Promise<ServiceEnd> second = wanderer(0, NamedColours.BLUE);
        test.crank();
        robots.tick(100);
        assertThat(test.error(second)).hasMessageContaining("sonar 3 reads NaN");
        assertThat(charge.of(0)).isEmpty();
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
    }

    @Test
    void behaviourThatThrows_stopsItsRobotOnce() {
        var broken = new Service("broken", false, () -> senses -> {
            throw new IllegalStateException("broken");
        });
        Promise<ServiceEnd> end = withTable(SubsumptionTable.forRobots(1)
                        .when(NamedColours.BLUE, broken)
                        .allowFinal()
                        .build())
                .drive(0, "broken", NamedColours.BLUE);
        test.crank();
        robots.tick(100);
        assertThat(test.error(end)).hasMessage("broken");
        assertThat(robots.commands(0)).containsExactly(STOP);
    }

    @Test
    void robotThatDoesNotExist_rejectsThePromise() {
        assertThat(test.error(wallFollower(7)))
                .isInstanceOf(PlayerException.class)
                .hasMessageContaining("position2d:7 is not in the device list")
                .hasMessageContaining("position2d:0, sonar:0");
    }

    @Test
    void serverThatGoesAway_rejectsThePromiseAndFreesTheRobot() {
        Promise<?> ended = wallFollower(0);
        test.crank();
        robots.tick(100);
        robots.vanish();
        assertThat(test.error(ended)).isInstanceOf(PlayerException.class).hasMessage("the server has gone");
        assertThat(charge.of(0)).isEmpty();
    }

    @Test
    void ringThatIsTooSmall_rejectsThePromise() {
        robots.range(0, 3, Double.NaN);
        Promise<?> ended = wallFollower(0);
        test.crank();
        robots.tick(100);
        assertThat(test.error(ended)).hasMessageContaining("sonar 3 reads NaN");
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
    }

    @Test
    void serverThatComesBack_isConnectedAnewByTheNextService() {
        Promise<?> ended = wallFollower(0);
        test.crank();
        robots.tick(100);
        robots.vanish();
        assertThat(test.error(ended)).isInstanceOf(PlayerException.class);
        test.crank();
        assertThat(robots.connections()).as("the dead connection").isZero();
        wallFollower(0);
        test.crank();
        assertThat(robots.connectionsMade()).isEqualTo(2);
        robots.tick(100);
        assertThat(charge.of(0)).containsExactly(Service.WALL_FOLLOWER);
        assertThat(robots.lastCommand(0)).isEqualTo(FOLLOWER_AHEAD);
    }

    @Test
    void wanderer_followsThePrioritiesAndTheHoldTimeOfItsTable() {
        var table = SubsumptionTable.forRobots(1)
                .when(NamedColours.BLUE, Service.SPACE_WANDERER)
                .when(NamedColours.RED, Service.SPACE_WANDERER)
                .when(NamedColours.GREEN, Service.SPACE_WANDERER)
                .priority(NamedColours.GREEN, -1)
                .hold(0.35)
                .build();
        Promise<ServiceEnd> end = withTable(table).drive(0, Service.SPACE_WANDERER.name(), NamedColours.BLUE);
        test.crank();
        robots.show(0, NamedColours.GREEN, NamedColours.RED); // green has the larger blob
        for (int i = 0; i < 4; i++) {
            robots.tick(100);
            assertThat(end.isDone()).as("after %d readings", i + 1).isFalse();
        }
        robots.tick(100);
        assertThat(test.get(end)).isEqualTo(saw(NamedColours.RED));
    }

    static class Listener extends Actor {
        private final RobotServices services;
        private final String service;
        private final List<String> received;

        Listener(RobotServices services, String service, List<String> received) {
            this.services = services;
            this.service = service;
            this.received = received;
        }

        public void listen() {
            services.drive(
                    0,
                    service,
                    (report, error) ->
                            received.add(error == null ? NamedColours.name(report.colour()) : error.getMessage()));
        }
    }

    @Test
    void callbackOfAnActorThatHasStopped_endsTheService() {
        var received = new ArrayList<String>();
        Listener listener =
                test.spawn(Listener.class, () -> new Listener(services, Service.SPACE_WANDERER.name(), received));
        listener.listen();
        test.crank();
        robots.show(0, NamedColours.RED);
        robots.tick(100);
        assertThat(received).containsExactly("red");
        test.space().stop(listener);
        test.crank();
        assertThat(charge.of(0)).as("until the next reading").containsExactly(Service.SPACE_WANDERER);

        var warnings = loggedByTheServices(() -> robots.tick(100));

        assertThat(robots.commands(0)).containsExactly(WANDERER_AHEAD, STOP);
        assertThat(charge.of(0)).isEmpty();
        assertThat(received).containsExactly("red");
        assertThat(warnings).containsExactly("robot 1: spaceWanderer stops, as nobody listens to it any more");
    }

    private static List<String> loggedByTheServices(Runnable body) {
        var messages = new ArrayList<String>();
        var logger = Logger.getLogger(RobotServicesActor.class.getName());
        var handler = new Handler() {
            @Override
            public void publish(LogRecord record) {
                messages.add(new SimpleFormatter().formatMessage(record));
            }

            @Override
            public void flush() {}

            @Override
            public void close() {}
        };
        logger.addHandler(handler);
        logger.setUseParentHandlers(false);
        try {
            body.run();
        } finally {
            logger.removeHandler(handler);
            logger.setUseParentHandlers(true);
        }
        return messages;
    }
}
