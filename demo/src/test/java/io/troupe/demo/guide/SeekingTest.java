package io.troupe.demo.guide;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.common.text.NamedColours;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceCatalogue;
import io.troupe.services.subsumption.ServiceObserver;
import io.troupe.services.subsumption.SubsumptionRun;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.services.subsumption.SubsumptionTableReader;
import io.troupe.sim.Simulation;
import io.troupe.sim.Snapshot;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.device.ColourBlob;
import io.troupe.sim.model.Pose;
import io.troupe.sim.worldfile.ScenarioReader;
import java.nio.file.Path;
import java.util.Optional;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/** The guide's behaviours that use the camera, and one with laser and stall, in worlds with a known outcome. */
@Timeout(120)
class SeekingTest {
    private static final double NEAR_M = 0.6;
    private static final double GAP_M = 0.8;
    private static final double LEADER_MPS = 0.2;
    /** The robots' cameras have 60 degrees in 80 columns. */
    private static final double COLUMN_RAD = Math.toRadians(60) / 80;

    private static final String ROBOTS = """
            name "open field"
            interval_sim 100
            include "pioneer.inc"
            include "laser.inc"
            """;

    private static Snapshot run(Mode mode, String things, int seconds, Service... services) throws Exception {
        var scenario = ScenarioReader.readText(ROBOTS + things, Path.of("worlds", "field.world"));
        var table = SubsumptionTable.forRobots(services.length)
                .when(NamedColours.BLUE, services)
                .allowFinal()
                .build();
        try (var simulation = Simulation.open(scenario, WorldSettings.DEFAULT);
                var run = SubsumptionRun.start(new SubsumptionRun.Settings(
                        mode, "localhost", 6665, table, simulation.clock(), ServiceObserver.NONE, (state, by) -> {}))) {
            for (int tick = 0; tick < 10 * seconds; tick++) {
                simulation.tick();
                run.check();
            }
            return simulation.latest();
        }
    }

    private static Service declared(String declaration) {
        var kinds = new SeekingKinds().kinds();
        var catalogue = ServiceCatalogue.standard().with(kinds.get(0)).with(kinds.get(1));
        return SubsumptionTableReader.service(declaration, catalogue);
    }

    private static ColourBlob seen(Snapshot snapshot, int robot, int colour) {
        return snapshot.robots().get(robot).blobs().blobs().stream()
                .filter(blob -> blob.colour() == colour)
                .findFirst()
                .orElseThrow();
    }

    @ParameterizedTest
    @EnumSource
    void lightSeeker_standsAtItsDistanceBeforeTheLight_andFacesIt(Mode mode) throws Exception {
        String world = """
                model ( color "red" size [ 0.1 0.1 0.5 ] pose [ 1.5 0.5 0 0 ] )
                model ( color "green" size [ 0.1 0.1 0.5 ] pose [ 1.5 -0.5 0 0 ] )
                pioneer2dx ( name "robot1" color "orange" pose [ 0 0 0 0 ] )
                """;
        var end = run(mode, world, 30, declared("light = seek(colour red)"));
        Pose pose = end.robots().getFirst().pose();
        ColourBlob light = seen(end, 0, NamedColours.RED);
        assertThat(light.rangeM()).isCloseTo(NEAR_M, within(0.001));
        assertThat(light.left() + light.right() + 1)
                .as("twice the middle column")
                .isBetween(79, 81);
        double bearingRad = Math.atan2(0.5 - pose.y(), 1.5 - pose.x());
        assertThat(pose.headingRad()).isCloseTo(bearingRad, within(2 * COLUMN_RAD));
    }

    @ParameterizedTest
    @EnumSource
    void leaderFollower_isTwoSecondsBehindItsGap(Mode mode) throws Exception {
        String world = """
                pioneer2dx ( name "leader" color "orange" pose [ 1.3 0.3 0 0 ] )
                pioneer2dx ( name "follower" color "black" pose [ 0 0 0 0 ] )
                """;
        Service leader = declared("leader = goToGoal(9, 0; speed " + LEADER_MPS + ")");
        var end = run(mode, world, 40, leader, declared("behind = follow(colour orange, gap " + GAP_M + ")"));
        Pose ahead = end.robots().get(0).pose();
        Pose behind = end.robots().get(1).pose();
        assertThat(ahead.x()).isCloseTo(1.3 + 40 * LEADER_MPS, within(0.1));
        // speed equal to its leader's: 0.5 / s times the distance above the gap
        double steadyM = GAP_M + LEADER_MPS / 0.5;
        assertThat(seen(end, 1, NamedColours.ORANGE).rangeM()).isCloseTo(steadyM, within(0.005));
        assertThat(ahead.x() - behind.x()).as("between the centres").isBetween(steadyM, steadyM + 0.35);
        assertThat(Math.abs(behind.y() - 0.3)).as("beside the leader's way").isLessThan(0.1);
    }

    @ParameterizedTest
    @EnumSource
    void laserAndStall_areThoseOfTheWorld(Mode mode) throws Exception {
        // the wall is 4 m in front of the laser, which is 0.1 m in front of the robot's centre
        String world = """
                model ( color "black" size [ 0.2 4 0.5 ] pose [ 4.2 0 0 0 ] )
                pioneer2dx ( name "robot1" color "orange" pose [ 0 0 0 0 ] scanner ( pose [ 0.1 0 0 0 ] ) )
                """;
        var firstM = new double[] {Double.NaN};
        var stalledAtM = new double[] {Double.NaN};
        Service ram = new Service("ram", false, () -> senses -> {
                    double aheadM = senses.laser().nearestM(-0.001, 0.001);
                    if (Double.isNaN(firstM[0])) {
                        firstM[0] = aheadM;
                    }
                    if (senses.stalled()) {
                        stalledAtM[0] = aheadM;
                        return Optional.empty();
                    }
                    return Optional.of(new Velocity(0.4, 0));
                })
                .withLaser();
        var end = run(mode, world, 15, ram);
        assertThat(firstM[0]).isCloseTo(4.0, within(0.03)); // a cell of the grid is 0.02 m
        double left = 4.1 - end.robots().getFirst().pose().x() - 0.1;
        assertThat(stalledAtM[0]).isCloseTo(left, within(0.05));
        assertThat(left).isLessThan(0.3);
    }
}
