package io.troupe.services.subsumption;

import static io.troupe.common.text.NamedColours.BLUE;
import static io.troupe.common.text.NamedColours.RED;
import static io.troupe.services.subsumption.FakeRobots.STOP;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import io.troupe.broker.MissingServiceException;
import io.troupe.broker.Need;
import io.troupe.bus.Bus;
import io.troupe.bus.BusSettings;
import io.troupe.bus.RemoteFailure;
import io.troupe.services.subsumption.RobotServices.Lease;
import io.troupe.services.subsumption.RobotServices.Renewal;
import io.troupe.services.subsumption.RobotServices.ServiceEnd;
import io.troupe.services.subsumption.RobotServices.Stamp;
import java.time.Duration;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/**
 * An arbitrator and providers on several nodes that exchange bytes, on a manual clock: who drives when a provider or
 * the arbitrator is gone. All providers share one record of who is in charge, so a robot with two drivers fails a test.
 */
class FailoverTest extends RobotsBench {
    private static final SubsumptionTable PAPER = SubsumptionTable.ofThePaper();
    private static final List<String> BOTH = List.of("wallFollower", "spaceWanderer");

    private final HostsPipe pipe = new HostsPipe(test.space());
    private final Map<String, RobotNode> nodes = new LinkedHashMap<>();
    private final List<Bus> buses = new ArrayList<>();
    private final List<String> drivers = new ArrayList<>(); // "a 1 starts", "a 1 ends", "a 1 loses"
    private final List<String> changes = new ArrayList<>(); // of drivers, as the arbitrator is notified
    private final RobotNode base = node("base");
    private @Nullable Throwable failure;

    private RobotNode node(String name) {
        Bus bus = pipe.open(name, BusSettings.on(test.space()).withObserver(loss -> {}));
        buses.add(bus);
        var node = RobotNode.open(bus, test.space(), event -> {}, 0);
        nodes.put(name, node);
        test.runQueued();
        return node;
    }

    private RobotNode.Offer offer(String name, List<String> services) {
        var offer = node(name).offer(test.space(), settings(PAPER).withObserver(observer(name)), services);
        test.get(offer.published());
        return offer;
    }

    private ServiceObserver observer(String node) {
        return new ServiceObserver() {
            @Override
            public void serviceStarted(int robot, Service service) {
                charge.serviceStarted(robot, service);
                drivers.add(node + " " + (robot + 1) + " starts");
            }

            @Override
            public void cycleEnded(int robot, Service service) {}

            @Override
            public void serviceEnded(int robot, Service service) {
                charge.serviceEnded(robot, service);
                drivers.add(node + " " + (robot + 1) + " ends");
            }

            @Override
            public void leaseLost(int robot, Service service) {
                drivers.add(node + " " + (robot + 1) + " loses");
            }
        };
    }

    @AfterEach
    void closeNodes() {
        nodes.values().forEach(node -> test.get(node.broker().closeAsync()));
        test.runQueued();
        buses.forEach(Bus::close);
        test.runQueued();
    }

    /** Time passes, with a reading each 100 ms. */
    private void seconds(double count) {
        for (int i = 0; i < StrictMath.round(count * 10); i++) {
            test.advance(Duration.ofMillis(100));
            robots.tick(100);
        }
    }

    private final class Changes implements SubsumptionRun.HostsListener {
        private final Events states = new Events();

        @Override
        public void stateStarted(State state, @Nullable Integer seenBy) {
            states.stateStarted(state, seenBy);
        }

        @Override
        public void reported(DriverReport report, String node) {}

        @Override
        public void driverLost(int robot, String service, Throwable why) {
            changes.add("lost " + (robot + 1));
        }

        @Override
        public void drivenAgain(int robot, String service) {
            changes.add("again " + (robot + 1));
        }
    }

    private LeasedRobots leased() {
        Map<String, RobotServices> byService = new LinkedHashMap<>();
        for (String service : BOTH) {
            var need = Need.ofCapability("arbitrator", service);
            byService.put(
                    service,
                    base.actors()
                            .connect(RobotServices.class, need, SubsumptionRun.LIMITS)
                            .actor());
        }
        test.runQueued();
        return LeasedRobots.overHosts(byService, test.space(), base.broker(), new Changes());
    }

    private Arbitrator run(Mode mode) {
        LeasedRobots services = leased();
        var arbitrator = test.spawn(Arbitrator.class, () -> new Arbitrator(mode, services, PAPER, new Changes()));
        arbitrator.live();
        arbitrator.failure().exceptionally(error -> {
            failure = error;
            return null;
        });
        seconds(0.5);
        return arbitrator;
    }

    private void assertNotDrivenFor(double count) {
        int before = robots.commands(0).size();
        seconds(count);
        assertThat(robots.commands(0)).as("commands to robot 1").hasSize(before);
    }

    // ---- in order

    @ParameterizedTest
    @EnumSource(names = {"PROMISE", "CALLBACK"})
    void eachService_isCalledWhereItIsOffered_andAColourChangesTheState(Mode mode) {
        offer("a", List.of("wallFollower"));
        offer("b", List.of("spaceWanderer"));
        run(mode);
        assertThat(drivers).containsExactly("a 1 starts", "b 2 starts");
        seconds(30);
        robots.show(1, RED);
        seconds(1);
        assertThat(states()).containsExactly("1 by null", "2 by 1");
        assertThat(drivers).hasSize(6).endsWith("b 1 starts", "a 2 starts");
        assertInCharge(SW, WF);
        robots.show(1);
        seconds(30);
        assertThat(drivers).as("leases are renewed").hasSize(6);
        assertThat(changes).isEmpty();
        assertThat(failure).isNull();
    }

    @Test
    void providerThatIsWithdrawn_stopsItsRobots_andAnotherOneDrivesAtOnce() {
        RobotNode.Offer leaving = offer("a", BOTH);
        offer("b", BOTH);
        run(Mode.PROMISE);
        var withdrawn = leaving.withdraw();
        test.runQueued();
        assertLastCommands(STOP, STOP);
        test.get(withdrawn);
        seconds(0.5);
        assertThat(drivers.subList(4, 6)).containsExactlyInAnyOrder("b 1 starts", "b 2 starts");
        assertThat(states()).containsExactly("1 by null");
    }

    // ---- a provider is gone

    private void assertAnotherDrivesWhenTheLeaseIsOver() {
        seconds(5);
        assertThat(drivers.subList(0, 2)).containsExactlyInAnyOrder("a 1 starts", "a 2 starts");
        assertThat(drivers).hasSize(8).contains("a 1 loses", "a 2 loses");
        assertThat(drivers.subList(6, 8)).containsExactlyInAnyOrder("b 1 starts", "b 2 starts");
        assertThat(changes).contains("lost 1", "lost 2", "again 1", "again 2");
        assertThat(states()).containsExactly("1 by null");
        assertInCharge(WF, SW);
        assertThat(failure).isNull();
    }

    @ParameterizedTest
    @EnumSource(names = {"PROMISE", "CALLBACK"})
    void providerThatIsSilent_stopsWithItsLease_andAnotherOneDrives_within5Seconds(Mode mode) {
        offer("a", BOTH);
        offer("b", BOTH);
        run(mode);
        pipe.lose("a");
        assertAnotherDrivesWhenTheLeaseIsOver();
    }

    @ParameterizedTest
    @EnumSource(names = {"PROMISE", "CALLBACK"})
    void providerThatIsKnownToBeGone_isReplacedOnlyWhenItsLeaseIsOver(Mode mode) {
        offer("a", BOTH);
        offer("b", BOTH);
        run(mode);
        pipe.disconnect("a");
        seconds(1.5);
        assertThat(drivers).as("it may still drive").hasSize(2);
        assertAnotherDrivesWhenTheLeaseIsOver();
    }

    @Test
    void providerThatHasLostItsRobots_stops_andAnotherOneDrives() {
        offer("a", BOTH);
        run(Mode.PROMISE);
        offer("b", BOTH);
        robots.vanish();
        test.runQueued();
        assertThat(charge.of(0)).isEmpty();
        seconds(3);
        assertThat(drivers).endsWith("b 1 starts", "b 2 starts").doesNotContain("a 1 loses");
        assertThat(failure).isNull();
    }

    @Test
    void noOtherProvider_endsTheRun_after5Seconds_withWhatIsOffered() {
        offer("a", BOTH);
        run(Mode.PROMISE);
        pipe.lose("a");
        seconds(6);
        assertThat(failure).isNull();
        seconds(5);
        assertThat(failure)
                .isInstanceOf(MissingServiceException.class)
                .hasMessageContainingAll("\"arbitrator\" needs the capability", "a/robotServices", "registered: ");
        assertThat(charge.of(0)).isEmpty();
    }

    @Test
    void frozenProvider_commandsNothing_whenItGoesOn() {
        offer("a", BOTH);
        run(Mode.PROMISE);
        int before = robots.commands(0).size();
        test.clock().advanceToAtLeast(test.clock().nanos() + 5_000_000_000L); // nothing runs meanwhile
        robots.tick(100);
        assertThat(drivers).contains("a 1 loses", "a 1 ends");
        assertThat(robots.commands(0)).as("not even a stop").hasSize(before);
        seconds(1);
        assertThat(drivers).endsWith("a 1 starts", "a 2 starts");
    }

    // ---- the arbitrator is gone

    @Test
    void arbitratorThatIsCutOff_hasItsRobotsStopped_andDrivesOnWhenItIsBack() {
        offer("a", List.of("wallFollower"));
        offer("b", List.of("spaceWanderer"));
        run(Mode.PROMISE);
        pipe.lose("base");
        seconds(2.2);
        assertThat(drivers).contains("a 1 loses", "b 2 loses", "a 1 ends", "b 2 ends");
        assertLastCommands(STOP, STOP);
        assertNotDrivenFor(1);
        pipe.loseNoMore("base");
        seconds(4);
        assertInCharge(WF, SW);
        assertThat(states()).containsExactly("1 by null");
        assertThat(failure).isNull();
    }

    @Test
    void spareProvidersThatTheArbitratorCouldNotReach_areTriedAgainOnceTheyReport() {
        offer("a", BOTH);
        offer("b", BOTH);
        offer("c", BOTH);
        run(Mode.PROMISE);
        pipe.disconnect("base");
        seconds(5); // no provider can be started now
        pipe.reconnect("base");
        seconds(5);
        assertInCharge(WF, SW);
        String driver = drivers.getLast().substring(0, 1);
        pipe.lose(driver);
        seconds(3.5);
        assertInCharge(WF, SW);
        assertThat(drivers.getLast()).endsWith(" starts").doesNotStartWith(driver);
        assertThat(failure).isNull();
    }

    @Test
    void spareProviderThatHasEndedByItself_isStartedAgain_whenItIsTheLast() {
        offer("a", BOTH);
        run(Mode.PROMISE);
        offer("b", BOTH);
        robots.vanish();
        seconds(3);
        assertThat(drivers).endsWith("b 1 starts", "b 2 starts");
        robots.vanish();
        seconds(0.4); // less than the first pause before a restart
        assertThat(drivers).endsWith("a 1 starts", "a 2 starts");
        assertThat(failure).isNull();
    }

    @Test
    void answerThatIsLost_isNoticedWithTheNextRenewal() {
        offer("a", BOTH);
        LeasedRobots services = leased();
        var end = call(() -> services.drive(1, "spaceWanderer", BLUE));
        seconds(1);
        robots.show(1, RED);
        test.advance(Duration.ofMillis(10)); // no renewal now
        pipe.loseNext(2); // the report of the colour, and the answer
        robots.tick(100);
        robots.show(1);
        assertThat(charge.of(1)).isEmpty();
        seconds(1);
        assertThat(end.isDone()).isFalse();
        assertThat(charge.of(1)).containsExactly(SW);
        assertThat(changes).containsExactly("lost 2", "again 2");
        test.get(call(() -> services.stop(1)));
        assertThat(test.get(end)).isEmpty();
    }

    // ---- stops

    @Test
    void stop_waitsForTheLeaseOfAProviderThatDoesNotAnswer() {
        offer("a", BOTH);
        LeasedRobots services = leased();
        var end = call(() -> services.drive(0, "wallFollower", BLUE));
        seconds(1);
        pipe.lose("a");
        Promise<?> stopped = call(() -> services.stop(0));
        seconds(1);
        assertThat(stopped.isDone()).isFalse();
        seconds(1.5);
        assertThat(stopped.isDone()).isTrue();
        assertThat(test.get(end)).isEmpty();
        assertThat(charge.of(0)).isEmpty();
        assertThat(test.get(call(() -> services.stop(0)))).isNull();
    }

    @Test
    void stop_whileAnotherProviderIsLookedFor_isDoneAtOnce() {
        LeasedRobots services = leased();
        var end = call(() -> services.drive(0, "wallFollower", BLUE));
        seconds(2);
        Promise<?> stopped = call(() -> services.stop(0));
        seconds(1);
        assertThat(stopped.isDone()).isTrue();
        assertThat(test.get(end)).isEmpty();
    }

    @Test
    void serviceThatIsCalledWhileTheOneBeforeIsStopping_startsElsewhere_whenThatOneHasStopped() {
        offer("a", List.of("wallFollower"));
        offer("b", List.of("spaceWanderer"));
        LeasedRobots services = leased();
        call(() -> services.drive(0, "wallFollower", BLUE));
        seconds(1);
        pipe.lose("a");
        test.run(() -> {
            services.stop(0);
            services.drive(0, "spaceWanderer", BLUE);
        });
        seconds(1);
        assertThat(drivers).as("a may still drive").containsExactly("a 1 starts");
        seconds(2);
        assertThat(drivers).containsExactly("a 1 starts", "a 1 loses", "a 1 ends", "b 1 starts");
        test.get(call(() -> services.stop(0)));
        pipe.loseNoMore("a"); // else its broker cannot be closed
        seconds(4);
    }

    @Test
    void robotThatIsDriven_isNotDrivenTwice_andAnUnknownServiceIsRefused() {
        offer("a", BOTH);
        LeasedRobots services = leased();
        call(() -> services.drive(0, "wallFollower", BLUE));
        assertThat(test.error(call(() -> services.drive(0, "spaceWanderer", BLUE))))
                .hasMessageContaining("robot 1 is in the charge of wallFollower");
        assertThat(test.error(call(() -> services.drive(1, "spaceWanderr", BLUE))))
                .hasMessageContaining("there is no service spaceWanderr");
        test.get(call(() -> services.stop(0)));
    }

    @Test
    void providerThatStartsSlowly_isWaitedFor() {
        LeasedRobots services = leased();
        var end = call(() -> services.drive(0, "wallFollower", BLUE));
        seconds(4);
        offer("a", BOTH);
        seconds(1);
        assertThat(drivers).containsExactly("a 1 starts");
        test.get(call(() -> services.stop(0)));
        test.get(end);
    }

    // ---- one provider

    private RobotServices provider() {
        offer("a", List.of("wallFollower"));
        return base.actors()
                .connect(RobotServices.class, Need.ofCapability("arbitrator", "wallFollower"), SubsumptionRun.LIMITS)
                .actor();
    }

    private Promise<ServiceEnd> drive(RobotServices provider, Lease lease) {
        var end = provider.drive(lease, 0, "wallFollower", BLUE);
        test.runQueued();
        return end;
    }

    @Test
    void callThatArrivesAfterItsLease_hasNoEffect() {
        RobotServices provider = provider();
        Stamp stamp = test.get(provider.stamp());
        seconds(2.1);
        assertThat(test.get(drive(provider, new Lease(1, 1, stamp)))).isEqualTo(ServiceEnd.LOST);
        var ofAnother = new Stamp(stamp.provider() + 1, stamp.nanos() + 2_100_000_000L);
        assertThat(test.get(drive(provider, new Lease(1, 1, ofAnother)))).isEqualTo(ServiceEnd.LOST);
        assertThat(test.get(drive(provider, new Lease(1, 1, Stamp.NONE)))).isEqualTo(ServiceEnd.LOST);
        assertThat(drivers).isEmpty();
    }

    @Test
    void lease_endsWithoutRenewal_andIsNotRenewedAfterItsEnd() {
        RobotServices provider = provider();
        var lease = new Lease(1, 1, test.get(provider.stamp()));
        var end = drive(provider, lease);
        seconds(1.5);
        Renewal renewal = test.get(provider.renew(lease, 0));
        assertThat(renewal.held()).isTrue();
        seconds(0.4);
        Lease renewed = lease.renewed(renewal.stamp());
        assertThat(test.get(provider.renew(renewed, 0)).held()).isTrue();
        seconds(1.5);
        assertThat(end.isDone()).isFalse();
        seconds(0.2);
        assertThat(test.get(end)).isEqualTo(ServiceEnd.LOST);
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
        assertThat(test.get(provider.renew(renewed, 0)).held()).isFalse();
        assertNotDrivenFor(1);
    }

    @Test
    void otherArbitrator_isRefused_whileTheLeaseOfTheFirstHolds() {
        RobotServices provider = provider();
        drive(provider, new Lease(1, 1, test.get(provider.stamp())));
        assertThat(test.error(drive(provider, new Lease(2, 1, test.get(provider.stamp())))))
                .isInstanceOf(RemoteFailure.class)
                .hasMessageContaining("robot 1 is driven for another arbitrator");
        seconds(2.1);
        var end = drive(provider, new Lease(2, 2, test.get(provider.stamp())));
        assertThat(drivers).endsWith("a 1 ends", "a 1 starts");
        seconds(2.1);
        assertThat(test.get(end)).isEqualTo(ServiceEnd.LOST);
    }

    @Test
    void newerLeaseOfTheSameArbitrator_replacesTheOlder_andALateOneHasNoEffect() {
        RobotServices provider = provider();
        Stamp stamp = test.get(provider.stamp());
        var first = drive(provider, new Lease(1, 2, stamp));
        seconds(0.5);
        var second = drive(provider, new Lease(1, 3, stamp));
        assertThat(test.get(first)).isEqualTo(ServiceEnd.LOST);
        assertThat(test.get(drive(provider, new Lease(1, 1, stamp)))).isEqualTo(ServiceEnd.LOST);
        assertThat(drivers).containsExactly("a 1 starts", "a 1 ends", "a 1 starts");
        test.get(provider.stop(new Lease(1, 3, stamp), 0));
        assertThat(test.get(second).colour()).isEmpty();
        assertThat(drivers).hasSize(4);
    }

    @Test
    void serviceThatANodeDoesNotOffer_isRefusedByName() {
        RobotServices provider = provider();
        var lease = new Lease(1, 1, test.get(provider.stamp()));
        assertThat(test.error(provider.drive(lease, 0, "spaceWanderer", BLUE)))
                .hasMessageContaining("the service spaceWanderer is not offered here, expected one of wallFollower");
    }

    @Test
    void reportThatIsRefused_orWhoseLeaseIsNotValid_endsItsCallback() {
        RobotServices provider = provider();
        Stamp stamp = test.get(provider.stamp());
        List<String> ends = new ArrayList<>();
        for (String service : List.of("spaceWanderer", "wallFollower")) {
            var reports = new Callback.Stream<RobotServices.ColourReport>(
                    report -> {}, error -> ends.add(service + " " + error));
            var ofAnother = new Stamp(stamp.provider() + 1, stamp.nanos());
            var end = provider.report(new Lease(1, 1, ofAnother), 0, service, reports);
            ends.add(test.get(end.handle((lost, error) -> error == null ? "lost" : "refused")));
        }
        assertThat(ends).containsExactly("spaceWanderer null", "refused", "wallFollower null", "lost");
    }

    @Test
    void robotsThatCannotBeReached_areTheReasonWhyThereIsNoProvider() {
        robots.refuses = true;
        offer("a", BOTH);
        assertThat(test.error(base.broker().require(Need.ofCapability("arbitrator", "wallFollower"))))
                .isInstanceOf(MissingServiceException.class)
                .hasMessageContainingAll("a/robotServices", "no more clients");
        test.takeProblems(); // of the starts
        robots.refuses = false;
    }
}
