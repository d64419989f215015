package io.troupe.sim;

import static io.troupe.sim.Specs.robot;
import static io.troupe.sim.Specs.wall;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import java.util.List;
import org.assertj.core.data.Offset;
import org.junit.jupiter.api.Test;

/** Unobstructed motion, compared with closed forms. */
class DrivingTest {
    private static final Offset<Double> EXACT = within(1e-9);

    private static World world(Pose start) {
        return World.create(Specs.world(robot("r1", start)), WorldSettings.DEFAULT);
    }

    private static RobotReading run(World world, int ticks) {
        for (int i = 0; i < ticks; i++) {
            world.advance();
        }
        return world.latest().robots().getFirst();
    }

    private static void assertPose(Pose actual, double x, double y, double headingRad) {
        assertThat(actual.x()).as("x").isCloseTo(x, EXACT);
        assertThat(actual.y()).as("y").isCloseTo(y, EXACT);
        assertThat(StrictMath.IEEEremainder(actual.headingRad() - headingRad, 2 * StrictMath.PI))
                .as("heading, from %s", headingRad)
                .isCloseTo(0, EXACT);
    }

    @Test
    void creation_givesTickZero_withDevicesRead() {
        World world = world(new Pose(1, 2, 0.5));

        Snapshot snapshot = world.latest();

        assertThat(snapshot.tick()).isZero();
        assertThat(snapshot.timeMicros()).isZero();
        assertThat(snapshot.contacts()).isEmpty();
        assertPose(snapshot.robots().getFirst().pose(), 1, 2, 0.5);
        assertThat(snapshot.robots().getFirst().odometry().pose()).isEqualTo(Pose.ORIGIN);
        assertThat(snapshot.robots().getFirst().sonarM()).isNull();
        assertThat(snapshot.robots().getFirst().blobs()).isNull();
        assertThat(snapshot.robots().getFirst().wallGapM()).isEqualTo(Double.POSITIVE_INFINITY);
    }

    @Test
    void straightDrive_endsAtSpeedTimesTime() {
        double heading = 0.7;
        World world = world(new Pose(1, -2, heading));
        world.command(0, 0.4, 0);

        RobotReading reading = run(world, 100);

        assertThat(world.timeMicros()).isEqualTo(10_000_000);
        assertThat(world.latest().tick()).isEqualTo(100);
        assertPose(reading.pose(), 1 + 4 * StrictMath.cos(heading), -2 + 4 * StrictMath.sin(heading), heading);
        assertPose(reading.odometry().pose(), 4, 0, 0);
        assertThat(reading.odometry().forwardMps()).isEqualTo(0.4);
        assertThat(reading.odometry().turnRadps()).isZero();
        assertThat(reading.odometry().stalled()).isFalse();
    }

    @Test
    void straightDrive_farFromTheOrigin_doesNotDrift() {
        World world = world(new Pose(450, 300, 0));
        world.command(0, 0.1, 0);

        assertPose(run(world, 300).pose(), 453, 300, 0);
    }

    @Test
    void arc_hasRadiusSpeedOverTurnRate() {
        double forward = 0.3;
        double turn = 0.25;
        double radius = forward / turn;
        World world = world(Pose.ORIGIN);
        world.command(0, forward, turn);

        for (int tick = 1; tick <= 400; tick++) {
            Pose pose = world.advance().robots().getFirst().pose();
            double angle = turn * tick / 10;
            assertPose(pose, radius * StrictMath.sin(angle), radius * (1 - StrictMath.cos(angle)), angle);
        }
    }

    @Test
    void turnInPlace_keepsTheCentreOfRotation_thoughTheCentreOfMassIsElsewhere() {
        World world = world(new Pose(3, 4, 0));
        world.command(0, 0, -0.45);

        assertPose(run(world, 600).pose(), 3, 4, -0.45 * 60);
    }

    @Test
    void body_followsTheCentreOfRotation_whenItTurns() {
        // from the centre of rotation the body reaches 0.18 m ahead and 0.26 m back
        RobotSpec robot = robot("r1", Pose.ORIGIN);
        World world = World.create(
                Specs.world(robot, wall("ahead", 1.5, 0, 1, 4), wall("behind", -2, 0, 1, 4)), WorldSettings.DEFAULT);
        assertThat(world.latest().robots().getFirst().wallGapM()).isCloseTo(1 - 0.18, EXACT);
        world.command(0, 0, StrictMath.PI / 2);

        RobotReading turned = run(world, 20);

        assertPose(turned.pose(), 0, 0, StrictMath.PI);
        assertThat(turned.wallGapM()).isCloseTo(1 - 0.26, EXACT);
    }

    @Test
    void newestCommand_winsAndHolds() {
        World world = world(Pose.ORIGIN);
        world.command(0, 5, 5);
        world.command(0, 0.2, 0);
        run(world, 10);

        assertPose(run(world, 10).pose(), 0.4, 0, 0);

        world.stop(0);
        assertPose(run(world, 10).pose(), 0.4, 0, 0);
    }

    @Test
    void reverse_drivesBackwards() {
        World world = world(Pose.ORIGIN);
        world.command(0, -0.1, 0);

        assertPose(run(world, 20).pose(), -0.2, 0, 0);
    }

    @Test
    void setOdometry_takesEffectWhereTheNextIntervalBegins() {
        World world = world(new Pose(1, 1, StrictMath.PI / 2));
        world.command(0, 1, 0);
        run(world, 10);
        world.setOdometry(0, new Pose(10, 20, StrictMath.PI));
        assertPose(world.latest().robots().getFirst().odometry().pose(), 1, 0, 0);

        RobotReading reading = run(world, 10);

        assertPose(reading.odometry().pose(), 9, 20, StrictMath.PI);
        assertPose(reading.pose(), 1, 3, StrictMath.PI / 2);
    }

    @Test
    void startOdometry_isWhatOdometryReportsAtTheStart() {
        RobotSpec plain = robot("r1", new Pose(1, 2, 0.5));
        RobotSpec global = new RobotSpec(
                plain.name(),
                plain.pose(),
                plain.shape(),
                plain.colour(),
                plain.lengthM(),
                plain.widthM(),
                plain.massKg(),
                plain.origin(),
                plain.pose(),
                null,
                null,
                List.of(),
                true,
                true,
                plain.where());
        World world = World.create(Specs.world(global), WorldSettings.DEFAULT);
        world.command(0, 0.5, 0.2);

        RobotReading reading = run(world, 37);

        Pose truth = reading.pose();
        assertPose(reading.odometry().pose(), truth.x(), truth.y(), truth.headingRad());
    }

    @Test
    void shorterPhysicsSteps_giveTheSameArc() {
        for (int stepMicros : List.of(1_000, 20_000, 100_000)) {
            World world = World.create(
                    Specs.world(robot("r1", Pose.ORIGIN)), WorldSettings.DEFAULT.withPhysicsStepMicros(stepMicros));
            world.command(0, 0.5, 0.5);

            assertPose(run(world, 20).pose(), StrictMath.sin(1), 1 - StrictMath.cos(1), 1);
        }
    }

    @Test
    void slowTurn_ofTenThousandSeconds_staysExact() {
        World world = world(Pose.ORIGIN);
        world.command(0, 0, 0.1);

        Snapshot end = world.advance(100_000);

        assertThat(StrictMath.IEEEremainder(
                        end.robots().getFirst().pose().headingRad() - 0.1 * 10_000, 2 * StrictMath.PI))
                .isCloseTo(0, within(1e-7));
    }
}
