package io.troupe.sim.device;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.Specs;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.OdometryError;
import io.troupe.sim.model.Pose;
import java.util.List;
import java.util.TreeSet;
import org.assertj.core.data.Offset;
import org.junit.jupiter.api.Test;

/** Odometry with errors, compared with closed forms. */
class Position2dTest {
    private static Pose report(Position2d odometry, Pose truth) {
        odometry.sense(truth.x(), truth.y(), truth.headingRad());
        return odometry.reported();
    }

    private static final Offset<Double> EXACT = within(1e-9);
    private static final OdometryError ERROR = new OdometryError(0.01, -0.02, 0.05);

    private static void assertPose(Pose actual, double x, double y, double headingRad) {
        assertThat(actual.x()).as("x").isCloseTo(x, EXACT);
        assertThat(actual.y()).as("y").isCloseTo(y, EXACT);
        assertThat(actual.headingRad()).as("heading").isCloseTo(headingRad, EXACT);
    }

    @Test
    void straightDrive_isCountedTooLong_inEveryDirection() {
        for (double heading : new double[] {0, 1, -2.5}) {
            var odometry = new Position2d(new Pose(3, 4, heading), Pose.ORIGIN, ERROR);
            for (int i = 1; i <= 100; i++) {
                report(
                        odometry,
                        new Pose(
                                3 + 0.05 * i * StrictMath.cos(heading),
                                4 + 0.05 * i * StrictMath.sin(heading),
                                heading));
            }
            Pose end = new Pose(3 + 5 * StrictMath.cos(heading), 4 + 5 * StrictMath.sin(heading), heading);
            assertPose(report(odometry, end), 5 * 1.01, 0, 0);
        }
    }

    @Test
    void push_sideways_isCountedTooShort() {
        var odometry = new Position2d(Pose.ORIGIN, Pose.ORIGIN, ERROR);
        assertPose(report(odometry, new Pose(0, -0.5, 0)), 0, -0.49, 0);
    }

    @Test
    void turn_isCountedTooFar_overAnyNumberOfTurns() {
        var odometry = new Position2d(Pose.ORIGIN, Pose.ORIGIN, ERROR);
        Pose reported = Pose.ORIGIN;
        for (int i = 1; i <= 200; i++) {
            reported = report(odometry, new Pose(0, 0, StrictMath.IEEEremainder(0.1 * i, 2 * StrictMath.PI)));
        }
        assertPose(reported, 0, 0, StrictMath.IEEEremainder(20 * 1.05, 2 * StrictMath.PI));
    }

    @Test
    void reset_keepsTheError() {
        var odometry = new Position2d(Pose.ORIGIN, Pose.ORIGIN, ERROR);
        report(odometry, new Pose(1, 0, 0));
        odometry.set(new Pose(1, 0, 0), new Pose(7, 8, StrictMath.PI / 2));

        assertPose(report(odometry, new Pose(2, 0, 0)), 7, 8 + 1.01, StrictMath.PI / 2);
        assertPose(report(odometry, new Pose(2, 0, 0)), 7, 8 + 1.01, StrictMath.PI / 2);
    }

    @Test
    void teleport_isNotCounted_butExactOdometryNotices() {
        var counting = new Position2d(Pose.ORIGIN, Pose.ORIGIN, ERROR);
        counting.sense(1, 0, 0);
        counting.teleported(new Pose(5, 5, 1));
        assertPose(report(counting, new Pose(5, 5, 1)), 1.01, 0, 0);

        var exact = new Position2d(Pose.ORIGIN, Pose.ORIGIN);
        exact.teleported(new Pose(5, 5, 1));
        assertPose(report(exact, new Pose(5, 5, 1)), 5, 5, 1);
    }

    @Test
    void world_drawsTheErrorFromSeedAndRobot_withinHalfOfWhatTheSpecificationSays() {
        var distances = new TreeSet<Double>();
        for (long seed = 1; seed <= 20; seed++) {
            distances.add(drive(seed, "r1"));
        }
        assertThat(distances).hasSize(20);
        assertThat(distances.getFirst()).isBetween(1 - 0.015, 1.0);
        assertThat(distances.getLast()).isBetween(1.0, 1 + 0.015);
        assertThat(drive(1, "r1")).isEqualTo(drive(1, "r1"));
        assertThat(drive(1, "r2")).isNotEqualTo(drive(1, "r1"));
    }

    /** The distance that odometry reports for a drive of one metre. */
    private static double drive(long seed, String robot) {
        World world = World.create(
                Specs.world(List.of(Specs.robot(robot, Pose.ORIGIN).withOdometryError(OdometryError.STAGE))),
                WorldSettings.DEFAULT.withSeed(seed));
        world.command(0, 1, 0);
        for (int i = 0; i < 10; i++) {
            world.advance();
        }
        return world.latest().robots().getFirst().odometry().pose().x();
    }
}
