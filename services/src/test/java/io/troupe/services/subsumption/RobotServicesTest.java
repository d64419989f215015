package io.troupe.services.subsumption;

import static io.troupe.common.text.NamedColours.BLACK;
import static io.troupe.common.text.NamedColours.BLUE;
import static io.troupe.common.text.NamedColours.GREEN;
import static io.troupe.common.text.NamedColours.ORANGE;
import static io.troupe.common.text.NamedColours.RED;
import static io.troupe.services.subsumption.FakeRobots.STOP;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatCode;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.Actor;
import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import io.troupe.bus.BusTopic;
import io.troupe.common.text.NamedColours;
import io.troupe.player.PlayerException;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.Blob;
import io.troupe.services.behaviour.LaserScan;
import io.troupe.services.behaviour.Senses;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.subsumption.RobotServices.ColourReport;
import io.troupe.services.subsumption.RobotServices.Lease;
import io.troupe.services.subsumption.RobotServices.Renewal;
import io.troupe.services.subsumption.RobotServices.ServiceEnd;
import io.troupe.services.subsumption.RobotServices.Stamp;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Optional;
import java.util.logging.Logger;
import java.util.logging.SimpleFormatter;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;

/** The robot services, called directly and by a client of the broker; and what a behaviour senses. */
class RobotServicesTest extends RobotsBench {
    private RobotServices services = services(settings(SubsumptionTable.ofThePaper()));
    private LeasedRobots leased = LeasedRobots.of(services);

    private RobotServices services(RobotServicesActor.Settings settings) {
        return test.spawn(RobotServices.class, () -> new RobotServicesActor(settings));
    }

    private void use(SubsumptionTable table) {
        services = services(settings(table).withObserver(ServiceObserver.none()));
        leased = LeasedRobots.of(services);
    }

    /** A lease that is never over. */
    private static Lease lease(long number) {
        return new Lease(1, number, Stamp.NONE);
    }

    private Promise<Optional<Integer>> drive(LeasedRobots robots, int robot, String service) {
        return call(() -> robots.drive(robot, service, BLUE));
    }

    private Promise<Optional<Integer>> drive(int robot, Service service, int stateColour) {
        return call(() -> leased.drive(robot, service.name(), stateColour));
    }

    private Promise<@Nullable Void> stop(int robot) {
        return call(() -> leased.stop(robot));
    }

    private Promise<Optional<Integer>> wallFollower(int robot) {
        return drive(robot, WF, BLUE);
    }

    private void assertSaw(Promise<Optional<Integer>> end, int colour) {
        assertThat(test.get(end)).contains(colour);
    }

    private void ticks(int... millis) {
        for (int each : millis) {
            robots.tick(each);
        }
    }

    @Test
    void stop_isNoticedWithoutWaitingForTheNextReading() {
        robots.show(0, RED); // a wall follower sees no colours
        Promise<Optional<Integer>> ended = wallFollower(0);
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(FOLLOWER_AHEAD);
        robots.range(0, 3, 0.3);
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(new DeviceCommand.Velocity(0, 0, -0.45, true));
        assertThat(ended.isDone()).isFalse();
        test.get(stop(0));
        assertThat(charge.of(0)).isEmpty();
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
        assertThat(test.get(ended)).isEmpty();
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
        test.get(stop(0)); // a second stop has no effect
        assertThat(robots.commands(0)).hasSize(3);
    }

    @Test
    void eachSpeedThatIsSent_isReportedBeforeTheServiceEnds() {
        wallFollower(0);
        robots.tick(100);
        robots.range(0, 3, 0.3);
        ticks(100, 100);
        test.get(stop(0));
        assertThat(charge.commanded(0))
                .hasSize(4)
                .endsWith(Velocity.STOP)
                .map(each -> new DeviceCommand.Velocity(each.forwardMps(), 0, each.turnRadps(), true))
                .isEqualTo(robots.commands(0));
        assertThat(charge.commanded(1)).isEmpty();
    }

    @Test
    void stopOfARobotWithoutAService_isDoneAtOnce_andACallThatIsCancelledWhileItIsQueuedHasNoEffect() {
        test.get(stop(1));
        assertThat(robots.connections()).isZero();
        assertCancelledCallHasNoEffect(services);
        assertCancelledCallHasNoEffect(connected(SubsumptionTable.ofThePaper()).get(WF.name()));
    }

    private void assertCancelledCallHasNoEffect(RobotServices called) {
        called.drive(lease(1), 0, WF.name(), BLUE).cancel();
        test.runQueued();
        robots.tick(100);
        assertThat(robots.connections()).isZero();
        assertThat(charge.of(0)).isEmpty();
    }

    @Test
    void robotThatDoesNotExist_rejectsThePromise() {
        for (var each : List.of(published(SubsumptionTable.ofThePaper()), leased)) {
            assertThat(test.error(drive(each, 7, WF.name())))
                    .isExactlyInstanceOf(PlayerException.class)
                    .hasMessageContaining("position2d:7 is not in the device list")
                    .hasMessageContaining("position2d:0, sonar:0");
        }
    }

    /** Drives a robot in callback mode, and records the colours and the error. */
    static class Listener extends Actor {
        private final RobotServices services;
        private final List<String> received;

        Listener(RobotServices services, List<String> received) {
            this.services = services;
            this.received = received;
        }

        public void listenTo(String service) {
            services.report(
                            lease(1),
                            0,
                            service,
                            (report, error) ->
                                    received.add(report == null ? "failed" : NamedColours.name(report.colour())))
                    .handle((end, error) -> received.add(error == null ? "stopped" : error.getMessage()));
        }
    }

    private final List<String> received = new ArrayList<>();

    private Listener listenTo(String service) {
        Listener listener = test.spawn(Listener.class, () -> new Listener(services, received));
        listener.listenTo(service);
        test.runQueued();
        return listener;
    }

    @Test
    void serviceThatTheTableDoesNotHave_isRefused_andTheOthersAreNamed() {
        String message = "there is no service wallFolower, expected one of wallFollower, spaceWanderer";
        for (var each : List.of(published(SubsumptionTable.ofThePaper()), leased)) {
            assertThat(test.error(drive(each, 0, "wallFolower")))
                    .isExactlyInstanceOf(IllegalArgumentException.class)
                    .hasMessage(message);
        }
        listenTo("wallFolower");
        assertThat(received).containsExactly(message);
    }

    @Test
    void callbackOfAnActorThatHasStopped_endsTheService() {
        Listener listener = listenTo(SW.name());
        robots.show(0, RED);
        robots.tick(100);
        assertThat(received).containsExactly("red");
        test.space().stop(listener);
        test.runQueued();
        assertThat(charge.of(0)).as("until the next reading").containsExactly(SW);

        var warnings = new ArrayList<String>();
        var logger = Logger.getLogger(RobotServicesActor.class.getName());
        logger.setFilter(record -> !warnings.add(new SimpleFormatter().formatMessage(record)));
        try {
            robots.tick(100);
        } finally {
            logger.setFilter(null);
        }
        assertThat(robots.commands(0)).containsExactly(WANDERER_AHEAD, STOP);
        assertThat(charge.of(0)).isEmpty();
        assertThat(received).containsExactly("red");
        assertThat(warnings).containsExactly("robot 1: spaceWanderer stops, as it has no listener any more");
    }

    /** Values could leave the process; a bus over hosts would have to carry the callback. */
    @Test
    void argumentsAndAnswers_areValues_exceptTheCallback() {
        assertThatCode(() -> new BusTopic<>("reports", ColourReport.class)).doesNotThrowAnyException();
        assertThatCode(() -> new BusTopic<>("ends", ServiceEnd.class)).doesNotThrowAnyException();
        assertThatCode(() -> new BusTopic<>("leases", Lease.class)).doesNotThrowAnyException();
        assertThat(RobotServices.class.getMethods())
                .flatExtracting(method -> Arrays.asList(method.getParameterTypes()))
                .containsOnly(Lease.class, int.class, String.class, Callback.class);
    }

    private void show(Optional<Integer> colour) {
        received.add("ended by " + colour);
    }

    @Test
    void robotsOfAProvider_areDrivenAndStopped() {
        test.run(() -> {
            var robots = LeasedRobots.of(services);
            robots.drive(0, "spaceWanderer", NamedColours.BLUE).then(colour -> show(colour));
            robots.stop(0);
        });
        assertThat(received).containsExactly("ended by Optional.empty");
        assertThat(robots.commands(0)).containsOnly(STOP);
    }

    // ---- colours

    @Test
    void wanderer_endsItselfAtAColour_andSendsItOnce() {
        Promise<Optional<Integer>> end = drive(1, SW, BLUE);
        robots.tick(100);
        assertThat(robots.lastCommand(1)).isEqualTo(WANDERER_AHEAD);
        robots.show(1, GREEN);
        robots.tick(100);
        assertSaw(end, GREEN);
        assertThat(robots.commands(1)).containsExactly(WANDERER_AHEAD, STOP);
        assertThat(charge.of(1)).isEmpty();
    }

    @Test
    void wanderer_ignoresBlackOrangeOtherColoursAndTheStatesOwn() {
        Promise<Optional<Integer>> end = drive(0, SW, BLUE);
        Promise<Optional<Integer>> endOfNoState = drive(1, SW, 0x123456); // ends at every colour that has a state
        for (int ignored : new int[] {BLACK, ORANGE, 0x123456, BLUE}) {
            assertThat(endOfNoState.isDone()).isFalse();
            robots.show(0, ignored);
            robots.show(1, ignored);
            robots.tick(100);
            assertThat(end.isDone()).as(NamedColours.name(ignored)).isFalse();
        }
        assertSaw(endOfNoState, BLUE);
        robots.show(0, RED);
        robots.tick(100);
        assertSaw(end, RED);
    }

    @Test
    void wanderer_followsThePrioritiesAndTheHoldTimeOfItsTable_alsoWhenTheClockIsSetBack() {
        use(SubsumptionTable.forRobots(2)
                .state(BLUE, SW, SW)
                .state(RED, SW, SW)
                .state(GREEN, SW, SW)
                .priority(GREEN, -1)
                .holdSeconds(0.35)
                .build());
        var end = drive(0, SW, BLUE);
        robots.show(0, GREEN, RED); // green has the larger blob
        for (int millis : new int[] {100_000, 100, 100, 100}) {
            robots.tick(millis);
            assertThat(end.isDone()).isFalse();
        }
        robots.tick(100);
        assertSaw(end, RED);
        var other = drive(1, SW, BLUE);
        robots.show(1, RED);
        for (int millis : new int[] {100, 100, -60_000, 100}) {
            robots.tick(millis);
            assertThat(other.isDone()).isFalse();
        }
        robots.tick(100);
        assertSaw(other, RED);
    }

    // ---- time

    @Test
    void cycle_takesAHundredMilliseconds_howeverOftenDataCome() {
        wallFollower(0);
        for (int i = 0; i < 10; i++) {
            robots.tick(50);
        }
        assertThat(robots.commands(0)).hasSize(5);
    }

    /** A pause of three readings is shorter than the command limit. */
    @Test
    void clockThatIsSetBackOrForward_leavesNoReadingWithoutACommand_untilLessThanACycleIsMadeUpFor() {
        wallFollower(0);
        for (int millis : new int[] {100, 100, -60_000, 100, 100, 60_000, 100, -150, 100, -60_000, 100}) {
            int before = robots.commands(0).size();
            robots.tick(millis);
            assertThat(robots.commands(0))
                    .as("commands after a step of %s ms", millis)
                    .hasSize(before + 1);
        }
        int before = robots.commands(0).size();
        ticks(-50, 100);
        assertThat(robots.commands(0)).hasSize(before);
        robots.tick(100);
        assertThat(robots.commands(0)).hasSize(before + 1);
    }

    @Test
    void behaviourAndReports_seeATimeThatGoesOn_whenTheClockIsSetBack() {
        use(table(looking, SW));
        drive(0, looking, BLUE);
        List<Double> inCharge = new ArrayList<>();
        test.run(() -> leased.report(1, SW.name(), report -> inCharge.add(report.secondsInCharge())));
        robots.show(1, RED);
        ticks(100_000, 100, -60_000, 100);
        assertThat(readings)
                .extracting(Senses::timeSeconds)
                .usingComparatorForType((a, b) -> Math.abs(a - b) < 1e-9 ? 0 : Double.compare(a, b), Double.class)
                .containsExactly(100.0, 100.1, 100.2, 100.3);
        assertThat(inCharge)
                .hasSize(4)
                .isSorted()
                .allSatisfy(seconds -> assertThat(seconds).isBetween(0.0, 0.35));
    }

    // ---- services that follow each other, and services that fail

    @Test
    void robot_isStoppedByItsServerIfItsServiceEnds_andASilentServerIsNoticed() {
        wallFollower(1);
        assertThat(robots.limits)
                .containsExactly(
                        "silence PT5S", "robot 2 troupe_command_limit_ms 400", "robot 2 troupe_command_age_ms 300");
    }

    @Test
    void secondService_beginsWhenTheFirstHasStopped() {
        test.run(() -> {
            leased.drive(0, WF.name(), BLUE); // has not started at the second call
            assertThatThrownBy(() -> leased.drive(0, SW.name(), BLUE))
                    .isInstanceOf(IllegalStateException.class)
                    .hasMessageContainingAll("robot 1 is in the charge of wallFollower", "stop the first before");
        });
        robots.tick(100);
        test.run(() -> {
            leased.stop(0);
            leased.drive(0, SW.name(), BLUE);
        });
        assertThat(charge.of(0)).containsExactly(SW);
        assertThat(robots.commands(0)).containsExactly(FOLLOWER_AHEAD, STOP, WANDERER_AHEAD);
        robots.tick(100);
        assertThat(robots.commands(0)).hasSize(4);
    }

    @Test
    void stop_alsoStopsAServiceThatHasSeenNothing_orThatStillWaitsForThePreviousOne() {
        Promise<Optional<Integer>> unseeing = drive(1, SW, GREEN);
        stop(1);
        assertThat(test.get(unseeing)).isEmpty();
        wallFollower(0);
        robots.tick(100);
        var waiting = new ArrayList<Promise<Optional<Integer>>>();
        test.run(
                () -> { // in one turn, in which the first service cannot end
                    leased.stop(0);
                    waiting.add(leased.drive(0, SW.name(), BLUE));
                    leased.stop(0);
                });
        assertThat(test.get(waiting.getFirst())).isEmpty();
        robots.tick(100);
        assertThat(robots.commands(0)).containsExactly(FOLLOWER_AHEAD, STOP);
        drive(0, SW, BLUE);
        assertThat(robots.lastCommand(0)).isEqualTo(WANDERER_AHEAD);
    }

    @Test
    void otherCaller_isRefused_whileTheFirstOneHasTheRobot() {
        wallFollower(0);
        var other = new Lease(1, 1, Stamp.NONE);
        assertThat(test.error(services.drive(other, 0, SW.name(), BLUE)))
                .isExactlyInstanceOf(PlayerException.class)
                .hasMessageContaining("robot 1 is driven for another arbitrator");
        test.get(services.stop(other, 0));
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(FOLLOWER_AHEAD);
        test.get(stop(0));
        services.drive(other, 0, SW.name(), BLUE);
        test.runQueued();
        assertThat(robots.lastCommand(0)).isEqualTo(WANDERER_AHEAD);
    }

    @Test
    void leaseThatWaits_untilTheServiceBeforeHasStopped_isHeld_andCanBeStopped() {
        var actors = new ArrayList<RobotServicesActor>();
        test.spawn(RobotServices.class, () -> {
                    actors.add(new RobotServicesActor(settings(SubsumptionTable.ofThePaper())));
                    return actors.getFirst();
                })
                .drive(lease(1), 0, WF.name(), BLUE);
        test.runQueued();
        robots.tick(100);
        var held = new ArrayList<Promise<Renewal>>();
        var ends = new ArrayList<Promise<ServiceEnd>>();
        test.run(
                () -> { // in one turn, in which the first service cannot end
                    RobotServicesActor provider = actors.getFirst();
                    ends.add(provider.drive(lease(2), 0, SW.name(), BLUE));
                    held.add(provider.renew(lease(1), 0));
                    held.add(provider.renew(lease(2), 0));
                    provider.stop(lease(2), 0);
                });
        assertThat(held).extracting(each -> test.get(each).held()).containsExactly(false, true);
        assertThat(test.get(ends.getFirst())).isEqualTo(new ServiceEnd(Optional.empty(), false));
        assertThat(robots.commands(0)).containsExactly(FOLLOWER_AHEAD, STOP);
    }

    @Test
    void stop_duringACycle_isNotForgotten() {
        var stopping = new Service("stopping", false, () -> senses -> {
            leased.stop(0);
            return Optional.empty();
        });
        use(table(stopping));
        Promise<Optional<Integer>> end = drive(0, stopping, BLUE);
        robots.tick(100);
        assertThat(end.isDone()).isTrue();
    }

    @Test
    void ringThatIsTooSmall_rejectsThePromise() {
        robots.range(0, 3, Double.NaN);
        Promise<?> ended = wallFollower(0);
        robots.tick(100);
        assertThat(test.error(ended)).hasMessageContaining("sonar 3 reads NaN");
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
        robots.range(0, 3, 5);
        robots.tick(100);
        wallFollower(0);
        robots.tick(100);
        robots.range(0, 3, Double.NaN);
        stop(0);
        robots.show(0, BLACK);
        Promise<Optional<Integer>> second = drive(0, SW, BLUE); // fails while it takes over
        robots.tick(100);
        assertThat(test.error(second)).hasMessageContaining("sonar 3 reads NaN");
        assertThat(charge.of(0)).as("the robot is free").isEmpty();
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
    }

    @Test
    void behaviourThatThrows_stopsItsRobotOnce() {
        var broken = new Service("broken", false, () -> senses -> {
            throw new IllegalStateException("broken");
        });
        use(table(broken));
        Promise<Optional<Integer>> end = drive(0, broken, BLUE);
        robots.tick(100);
        assertThat(test.error(end)).hasMessage("broken");
        assertThat(robots.commands(0)).containsExactly(STOP);
    }

    @Test
    void serverThatGoesAway_rejectsThePromise_andIsConnectedAnewByTheNextService() {
        Promise<?> ended = wallFollower(0);
        robots.tick(100);
        robots.vanish();
        assertThat(test.error(ended)).isInstanceOf(PlayerException.class).hasMessage("the server has gone");
        assertThat(charge.of(0)).isEmpty();
        test.runQueued();
        assertThat(robots.connections()).as("the dead connection").isZero();
        wallFollower(0);
        assertThat(robots.connectionsMade).isEqualTo(2);
        robots.tick(100);
        assertThat(charge.of(0)).containsExactly(WF);
        assertThat(robots.lastCommand(0)).isEqualTo(FOLLOWER_AHEAD);
    }

    // ---- blobs, laser scans and stalls, and which devices are subscribed to for them

    private final List<Senses> readings = new ArrayList<>();
    private final Service looking = new Service("looking", false, this::note);
    private final Service scanning = new Service("scanning", false, this::note).withLaser();

    private Behaviour note() {
        return senses -> {
            readings.add(senses);
            return Optional.of(
                    new Velocity(senses.laser().isEmpty() ? 0 : senses.laser().rangeM(1), 0));
        };
    }

    private void assertBeams(Integer... beams) {
        assertThat(readings).extracting(each -> each.laser().size()).containsExactly(beams);
    }

    @Test
    void behaviour_getsBlobsAndStall_ofTheSameReading() {
        use(table(looking, looking));
        drive(0, looking, BLUE);
        robots.tick(100);
        robots.show(0, RED);
        robots.get(0).isStalled = true;
        robots.tick(100);
        assertThat(readings).extracting(Senses::stalled).containsExactly(false, true);
        assertThat(readings.getFirst().largestBlob(RED)).isEmpty();
        assertThat(readings.getLast().largestBlob(RED)).hasValue(new Blob(RED, 100, 35, 45, 25, 35, 80, 60, 1));
    }

    @Test
    void layerWithLaser_makesItsServiceUseIt_andOnlyItsRobotIsSubscribedToAndGetsTheScan() {
        robots.get(0).hasLaser = true;
        robots.get(1).hasLaser = true;
        Service layers = scanning.over(WF);
        assertThat(layers.usesLaser()).isTrue();
        use(table(layers, looking));
        drive(0, layers, BLUE);
        drive(1, looking, BLUE);
        robots.tick(100);
        assertThat(robots.laserSubscriptions(0)).isOne();
        assertThat(robots.laserSubscriptions(1)).isZero();
        assertLastCommands(FakeRobots.ahead(2), STOP);
        assertBeams(3, 0);
        var scan = readings.getFirst().laser();
        assertThat(scan.bearingRad(2)).isEqualTo((float) (Math.PI / 2));
        assertThat(scan.maxRangeM()).isEqualTo(8);
        assertThat(readings.getLast().laser()).isEqualTo(LaserScan.EMPTY);
    }

    @Test
    void serviceWithLaserThatTheTableGivesToAnotherRobot_getsTheLaserAllTheSame_andOneWithoutGetsNoScan() {
        robots.get(0).hasLaser = true;
        robots.get(1).hasLaser = true;
        use(table(looking, scanning));
        drive(0, looking, BLUE);
        robots.tick(100);
        test.get(stop(0));
        drive(0, scanning, BLUE);
        ticks(100, 100);
        assertBeams(0, 3, 3);
        test.get(stop(0));
        readings.clear();
        drive(0, looking, BLUE);
        ticks(100, 100);
        assertThat(robots.laserSubscriptions(0)).isOne();
        assertBeams(0, 0, 0);
    }

    @Test
    void robotWithoutLaser_isAnErrorThatNamesIt_andItsRobotCanBeServedAgain() {
        use(table(scanning, looking));
        assertThat(test.error(drive(0, scanning, BLUE)))
                .isInstanceOf(PlayerException.class)
                .hasMessageStartingWith("robot 1 is to use its laser: ")
                .hasMessageContaining("laser:0 is not in the device list");
        assertThat(robots.connections()).isZero();
        use(table(looking, scanning)); // the table gives the service to another robot
        assertThat(test.error(drive(0, scanning, BLUE)))
                .isInstanceOf(PlayerException.class)
                .hasMessageContaining("laser:0");
        assertThat(robots.connections()).isZero();
        drive(0, looking, BLUE);
        robots.tick(100);
        assertThat(robots.connections()).isOne();
        assertThat(readings).hasSize(1);
    }

    @Test
    void kindWithLaser_makesServicesThatUseIt_declaredOrByItsName() {
        var kind = new ServiceCatalogue.Kind("look", true, true, arguments -> this::note).withLaser();
        var table = SubsumptionTableReader.parse(
                "robots 3\nservice far = look\nstate red : far, look, spaceWanderer\n",
                Path.of("t"),
                ServiceCatalogue.standard().with(kind));
        assertThat(table.first().services()).extracting(Service::usesLaser).containsExactly(true, true, false);
        assertThat(table.robotsWithLaser()).containsExactly(1, 2);
    }
}
