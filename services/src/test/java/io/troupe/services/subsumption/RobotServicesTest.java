package io.troupe.services.subsumption;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.common.text.NamedColours;
import io.troupe.player.PlayerException;
import io.troupe.player.wire.DeviceCommand;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.OptionalInt;
import java.util.concurrent.atomic.AtomicReference;
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
            () -> new RobotServices(RobotServices.Settings.ofThePaper()
                    .withPort(FakeRobots.PORT)
                    .withObserver(charge)));

    @AfterEach
    void nothingIsLeft() {
        test.close();
        robots.close();
        assertThat(robots.connections()).as("connections left open").isZero();
        assertThat(charge.most()).as("services of a robot at the same time").isLessThanOrEqualTo(1);
    }

    private static AtomicReference<Integer> running() {
        return new AtomicReference<>(1);
    }

    @Test
    void wallFollower_drivesByItsLaw_untilItsReferenceIsCleared() {
        var reference = running();
        Promise<?> ended = services.wallFollower(0, reference);
        test.crank();
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(FOLLOWER_AHEAD);
        robots.range(0, 3, 0.3);
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(new DeviceCommand.Velocity(0, 0, -0.45, true));
        reference.set(0);
        assertThat(ended.isDone()).isFalse();
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
        assertThat(reference).hasValue(2);
        test.crank();
        assertThat(ended.isDone()).isTrue();
        assertThat(robots.commands(0)).hasSize(3);
    }

    @Test
    void stop_isNoticedWithoutWaitingForTheNextReading() {
        var reference = running();
        services.wallFollower(0, reference);
        test.crank();
        robots.tick(100);
        test.get(services.stop(reference));
        assertThat(reference).hasValue(2);
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
        test.get(services.stop(reference)); // a second stop has no effect
    }

    @Test
    void wanderer_endsItselfAtAColour_andSendsItOnce() {
        var reference = running();
        var finder = running();
        Promise<Integer> colour = services.spaceWanderer(1, reference, finder, NamedColours.BLUE);
        test.crank();
        robots.tick(100);
        assertThat(robots.lastCommand(1)).isEqualTo(WANDERER_AHEAD);
        robots.show(1, NamedColours.GREEN);
        robots.tick(100);
        assertThat(test.get(colour)).isEqualTo(NamedColours.GREEN);
        assertThat(robots.commands(1)).containsExactly(WANDERER_AHEAD, STOP);
        assertThat(reference).hasValue(2);
        assertThat(finder).hasValue(2);
    }

    @Test
    void wanderer_ignoresBlackOrangeOtherColoursAndTheStatesOwn() {
        Promise<Integer> colour = services.spaceWanderer(0, running(), running(), NamedColours.BLUE);
        for (int ignored : new int[] {NamedColours.BLACK, NamedColours.ORANGE, 0x123456, NamedColours.BLUE}) {
            robots.show(0, ignored);
            robots.tick(100);
            assertThat(colour.isDone()).as(NamedColours.name(ignored)).isFalse();
        }
        robots.show(0, NamedColours.RED);
        robots.tick(100);
        assertThat(test.get(colour)).isEqualTo(NamedColours.RED);
    }

    @Test
    void wanderer_withoutItsColourFinder_seesNothing() {
        Promise<Integer> colour = services.spaceWanderer(0, running(), new AtomicReference<>(0), NamedColours.BLUE);
        robots.show(0, NamedColours.RED);
        robots.tick(100);
        robots.tick(100);
        assertThat(colour.isDone()).isFalse();
    }

    @Test
    void wanderer_stoppedBeforeItSawAnything_answersTheStatesOwnColour() {
        var reference = running();
        Promise<Integer> colour = services.spaceWanderer(0, reference, running(), NamedColours.GREEN);
        test.crank();
        services.stop(reference);
        assertThat(test.get(colour)).isEqualTo(NamedColours.GREEN);
    }

    @Test
    void clockThatIsSetBackOrForward_leavesNoReadingWithoutACommand() {
        services.wallFollower(0, running());
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
        services.wallFollower(0, running());
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
        services.serve(0, clock, running(), new AtomicReference<>(0), ColourRule.NONE);
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
        List<Double> inCharge = new ArrayList<>();
        ColourRule rule = (sightings, seconds) -> {
            inCharge.add(seconds);
            return OptionalInt.empty();
        };
        services.serve(0, Service.SPACE_WANDERER, running(), running(), rule);
        test.crank();
        for (int millis : new int[] {100_000, 100, -60_000, 100}) {
            robots.tick(millis);
        }
        assertThat(inCharge)
                .hasSize(4)
                .isSorted()
                .allSatisfy(seconds -> assertThat(seconds).isBetween(0.0, 0.35));
    }

    @Test
    void robot_isStoppedByItsServerIfItsServiceEnds_andASilentServerIsNoticed() {
        services.wallFollower(1, running());
        test.crank();
        assertThat(robots.limits()).containsExactly("silence PT5S", "robot 2 troupe_command_limit_ms 400");
    }

    @Test
    void cycle_takesAHundredMilliseconds_howeverOftenDataCome() {
        services.wallFollower(0, running());
        test.crank();
        for (int i = 0; i < 10; i++) {
            robots.tick(50);
        }
        assertThat(robots.commands(0)).hasSize(5);
    }

    @Test
    void secondService_whileTheFirstIsNotToldToStop_isRefused() {
        services.wallFollower(0, running());
        Throwable error = test.error(services.spaceWanderer(0, running(), running(), NamedColours.BLUE));
        assertThat(error)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("robot 1 is in the charge of wallFollower")
                .hasMessageContaining("set the reference of the first to 0");
    }

    @Test
    void secondService_beginsWhenTheFirstHasStopped() {
        var first = running();
        services.wallFollower(0, first);
        test.crank();
        robots.tick(100);
        first.set(0);
        services.spaceWanderer(0, running(), running(), NamedColours.BLUE);
        test.crank();
        assertThat(charge.of(0)).containsExactly(Service.SPACE_WANDERER);
        assertThat(first).hasValue(2);
        assertThat(robots.commands(0)).containsExactly(FOLLOWER_AHEAD, STOP, WANDERER_AHEAD);
        robots.tick(100);
        assertThat(robots.commands(0)).hasSize(4);
    }

    @Test
    void serviceThatFailsWhileItTakesOver_rejectsItsPromiseAndFreesTheRobot() {
        var first = running();
        services.wallFollower(0, first);
        test.crank();
        robots.tick(100);
        robots.range(0, 3, Double.NaN);
        services.stop(first);
        test.crank();
        robots.show(0, NamedColours.BLACK);
        var finder = running();
        Promise<Integer> second = services.spaceWanderer(0, running(), finder, NamedColours.BLUE);
        test.crank();
        robots.tick(100);
        assertThat(test.error(second)).hasMessageContaining("sonar 3 reads NaN");
        assertThat(finder).hasValue(2);
        assertThat(charge.of(0)).isEmpty();
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
    }

    @Test
    void referenceOfAnotherRobotsService_isRefused() {
        var shared = running();
        services.wallFollower(0, shared);
        assertThat(test.error(services.wallFollower(1, shared)))
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("the reference for wallFollower of robot 2 belongs to wallFollower of another")
                .hasMessageContaining("give each service a reference of its own");
    }

    @Test
    void robotThatDoesNotExist_rejectsThePromise() {
        assertThat(test.error(services.wallFollower(7, running())))
                .isInstanceOf(PlayerException.class)
                .hasMessageContaining("position2d:7 is not in the device list")
                .hasMessageContaining("position2d:0, sonar:0");
    }

    @Test
    void serverThatGoesAway_rejectsThePromiseAndFreesTheRobot() {
        var reference = running();
        Promise<?> ended = services.wallFollower(0, reference);
        test.crank();
        robots.tick(100);
        robots.vanish();
        assertThat(test.error(ended)).isInstanceOf(PlayerException.class).hasMessage("the server has gone");
        assertThat(reference).hasValue(2);
        assertThat(charge.of(0)).isEmpty();
    }

    @Test
    void ringThatIsTooSmall_rejectsThePromise() {
        robots.range(0, 3, Double.NaN);
        Promise<?> ended = services.wallFollower(0, running());
        test.crank();
        robots.tick(100);
        assertThat(test.error(ended)).hasMessageContaining("sonar 3 reads NaN");
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
    }

    @Test
    void serverThatComesBack_isConnectedAnewByTheNextService() {
        Promise<?> ended = services.wallFollower(0, running());
        test.crank();
        robots.tick(100);
        robots.vanish();
        assertThat(test.error(ended)).isInstanceOf(PlayerException.class);
        test.crank();
        assertThat(robots.connections()).as("the dead connection").isZero();
        services.wallFollower(0, running());
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
        var held = test.spawn(
                RobotServices.class,
                () -> new RobotServices(RobotServices.Settings.ofThePaper()
                        .withPort(FakeRobots.PORT)
                        .withTable(table)));
        Promise<Integer> colour = held.spaceWanderer(0, running(), running(), NamedColours.BLUE);
        test.crank();
        robots.show(0, NamedColours.GREEN, NamedColours.RED); // green has the larger blob
        for (int i = 0; i < 4; i++) {
            robots.tick(100);
            assertThat(colour.isDone()).as("after %d readings", i + 1).isFalse();
        }
        robots.tick(100);
        assertThat(test.get(colour)).isEqualTo(NamedColours.RED);
    }

    static class Listener extends Actor {
        private final RobotServices services;
        private final AtomicReference<Integer> reference;
        private final AtomicReference<Integer> finder;
        private final List<Integer> heard;

        Listener(
                RobotServices services,
                AtomicReference<Integer> reference,
                AtomicReference<Integer> finder,
                List<Integer> heard) {
            this.services = services;
            this.reference = reference;
            this.finder = finder;
            this.heard = heard;
        }

        public void listen() {
            services.spaceWanderer((colour, error) -> heard.add(colour), 0, reference, finder);
        }
    }

    @Test
    void callbackOfAnActorThatHasStopped_endsTheService() {
        var reference = running();
        var finder = running();
        var heard = new ArrayList<Integer>();
        Listener listener = test.spawn(Listener.class, () -> new Listener(services, reference, finder, heard));
        listener.listen();
        test.crank();
        robots.show(0, NamedColours.RED);
        robots.tick(100);
        assertThat(heard).containsExactly(NamedColours.RED);
        test.space().stop(listener);
        test.crank();
        assertThat(charge.of(0)).as("until the next reading").containsExactly(Service.SPACE_WANDERER);

        var warnings = loggedByTheServices(() -> robots.tick(100));

        assertThat(robots.commands(0)).containsExactly(WANDERER_AHEAD, STOP);
        assertThat(reference).hasValue(2);
        assertThat(finder).hasValue(2);
        assertThat(charge.of(0)).isEmpty();
        assertThat(heard).containsExactly(NamedColours.RED);
        assertThat(warnings).containsExactly("robot 1: spaceWanderer stops, as nobody listens to it any more");
    }

    private static List<String> loggedByTheServices(Runnable body) {
        var messages = new ArrayList<String>();
        var logger = Logger.getLogger(RobotServices.class.getName());
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
