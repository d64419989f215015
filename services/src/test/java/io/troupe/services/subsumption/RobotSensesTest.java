package io.troupe.services.subsumption;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.common.text.NamedColours;
import io.troupe.player.PlayerException;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.LaserScan;
import io.troupe.services.behaviour.Senses;
import io.troupe.services.behaviour.Velocity;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** Tests which blobs, laser scans and stalls a behaviour gets, and which devices are subscribed to for it. */
class RobotSensesTest {
    private final TestSpace test = new TestSpace();
    private final FakeRobots robots = new FakeRobots(test, 2);
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

    @AfterEach
    void close() {
        test.close();
        robots.close();
    }

    private RobotServices services(Service first, Service second) {
        var table = SubsumptionTable.forRobots(2)
                .when(NamedColours.BLUE, first, second)
                .allowFinal()
                .build();
        var settings = RobotServicesActor.Settings.ofThePaper()
                .withPort(FakeRobots.PORT)
                .withTable(table);
        return test.spawn(RobotServices.class, () -> new RobotServicesActor(settings));
    }

    private Promise<?> serve(RobotServices services, int robot, Service service) {
        Promise<?> end = services.drive(robot, service.name(), NamedColours.BLUE);
        test.crank();
        return end;
    }

    @Test
    void behaviour_getsBlobsAndStall_ofTheSameReading() {
        serve(services(looking, looking), 0, looking);
        robots.tick(100);
        robots.show(0, NamedColours.RED);
        robots.stall(0);
        robots.tick(100);
        assertThat(readings).extracting(Senses::stalled).containsExactly(false, true);
        assertThat(readings.getFirst().largestBlob(NamedColours.RED)).isEmpty();
        assertThat(readings.getLast().largestBlob(NamedColours.RED)).hasValueSatisfying(blob -> {
            assertThat(List.of(blob.leftPx(), blob.rightPx(), blob.topPx(), blob.bottomPx()))
                    .containsExactly(35, 45, 25, 35);
            assertThat(List.of(blob.imageWidthPx(), blob.imageHeightPx())).containsExactly(80, 60);
            assertThat(blob.rangeM()).isEqualTo(1);
            assertThat(blob.areaPx2()).isEqualTo(100);
        });
    }

    @Test
    void serviceWithoutLaser_getsAnEmptyScan_andNothingIsSubscribedTo() {
        robots.giveLaser(0);
        serve(services(looking, looking), 0, looking);
        robots.tick(100);
        assertThat(readings).extracting(Senses::laser).containsExactly(LaserScan.EMPTY);
        assertThat(robots.laserSubscriptions(0)).isZero();
    }

    @Test
    void serviceWithLaser_getsTheScan_andOnlyItsRobotIsSubscribedTo() {
        robots.giveLaser(0);
        robots.giveLaser(1);
        var services = services(scanning, looking);
        serve(services, 0, scanning);
        serve(services, 1, looking);
        robots.tick(100);
        assertThat(robots.laserSubscriptions(0)).isOne();
        assertThat(robots.laserSubscriptions(1)).isZero();
        assertThat(robots.lastCommand(0)).isEqualTo(new DeviceCommand.Velocity(2, 0, 0, true));
        assertThat(robots.lastCommand(1)).isEqualTo(new DeviceCommand.Velocity(0, 0, 0, true));
        var scan = readings.getFirst().laser();
        assertThat(scan.bearingRad(2)).isEqualTo((float) (Math.PI / 2));
        assertThat(scan.maxRangeM()).isEqualTo(8);
    }

    @Test
    void layerWithLaser_makesItsServiceUseIt() {
        robots.giveLaser(0);
        Service layers = scanning.over(Service.WALL_FOLLOWER);
        assertThat(layers.usesLaser()).isTrue();
        serve(services(layers, looking), 0, layers);
        robots.tick(100);
        assertThat(readings.getFirst().laser().size()).isEqualTo(3);
    }

    @Test
    void serviceThatTheTableGivesToAnotherRobot_getsTheLaserAllTheSame() {
        robots.giveLaser(0);
        var services = services(looking, scanning);
        serve(services, 0, looking);
        robots.tick(100);
        test.get(services.stop(0));
        serve(services, 0, scanning);
        robots.tick(100);
        robots.tick(100);
        assertThat(readings).extracting(each -> each.laser().size()).containsExactly(0, 3, 3);
    }

    @Test
    void serviceWithoutLaser_getsNoScan_evenIfAnotherOfItsRobotHasSubscribed() {
        robots.giveLaser(0);
        robots.giveLaser(1);
        var services = services(scanning, looking);
        serve(services, 0, scanning);
        robots.tick(100);
        test.get(services.stop(0));
        serve(services, 0, looking);
        robots.tick(100);
        robots.tick(100);
        assertThat(robots.laserSubscriptions(0)).isOne();
        assertThat(readings).extracting(each -> each.laser().size()).containsExactly(3, 0, 0, 0);
    }

    @Test
    void serviceThatTheTableGivesToAnotherRobot_isRefusedWithoutALaser_andItsRobotCanBeServedAgain() {
        var services = services(looking, scanning);
        var end = serve(services, 0, scanning);
        assertThat(test.error(end)).isInstanceOf(PlayerException.class).hasMessageContaining("laser:0");
        assertThat(robots.connections()).isZero();
        serve(services, 0, looking);
        robots.tick(100);
        assertThat(robots.connections()).isOne();
        assertThat(readings).hasSize(1);
    }

    @Test
    void robotWithoutLaser_isAnErrorThatNamesIt() {
        var services = services(scanning, looking);
        var end = serve(services, 0, scanning);
        assertThat(test.error(end))
                .isInstanceOf(PlayerException.class)
                .hasMessageStartingWith("robot 1 is to use its laser: ")
                .hasMessageContaining("laser:0 is not in the device list");
        assertThat(robots.connections()).isZero();
    }

    @Test
    void kindWithLaser_makesServicesThatUseIt_declaredOrByItsName() {
        var catalogue = ServiceCatalogue.standard()
                .with(new ServiceCatalogue.Kind("look", true, true, arguments -> this::note).withLaser());
        var table = SubsumptionTableReader.parse(
                "robots 3\nservice far = look\nstate red : far, look, spaceWanderer\n", Path.of("t"), catalogue);
        assertThat(table.first().services()).extracting(Service::usesLaser).containsExactly(true, true, false);
        assertThat(table.robotsWithLaser()).containsExactly(1, 2);
    }
}
