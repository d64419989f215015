package io.troupe.sim;

import static io.troupe.sim.Specs.R1;
import static io.troupe.sim.Specs.driven;
import static io.troupe.sim.Specs.first;
import static io.troupe.sim.Specs.robot;
import static io.troupe.sim.Specs.run;
import static io.troupe.sim.Specs.start;
import static io.troupe.sim.Specs.wall;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.device.ColourBlob;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import java.util.List;
import org.assertj.core.data.Offset;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** Motion compared with closed forms: speeds, goals, headings, motor power, teleports, the watchdog and cargo. */
class DrivingTest {
    private static final Offset<Double> EXACT = within(1e-9);

    private static World worldAt(double x, double y, double headingRad) {
        return start(robot("r1", x, y, headingRad));
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
        Snapshot snapshot = worldAt(1, 2, 0.5).latest();
        RobotReading reading = first(snapshot);
        assertPose(reading.pose(), 1, 2, 0.5);
        var odometry = new Odometry(Pose.ORIGIN, 0, 0, false);
        var expected = new RobotReading(reading.pose(), odometry, null, null, List.of(), Double.POSITIVE_INFINITY);
        assertThat(snapshot).isEqualTo(new Snapshot(0, 0, List.of(expected), List.of()));
    }

    @Test
    void straightDrive_endsAtSpeedTimesTime() {
        double heading = 0.7;
        World world = driven(0.4, worldAt(1, -2, heading));
        RobotReading reading = run(world, 100);
        assertThat(world.timeMicros()).isEqualTo(10_000_000);
        assertThat(world.latest().tick()).isEqualTo(100);
        assertPose(reading.pose(), 1 + 4 * StrictMath.cos(heading), -2 + 4 * StrictMath.sin(heading), heading);
        assertPose(reading.odometry().pose(), 4, 0, 0);
        assertThat(reading.odometry()).isEqualTo(new Odometry(reading.odometry().pose(), 0.4, 0, false));
    }

    /**
     * One row drives straight on far from the origin. The last one turns on the spot: the centre of rotation stays,
     * though the centre of mass is elsewhere.
     */
    @ParameterizedTest
    @CsvSource({
        "0, 0, 0.3, 0.25, 400, 10000",
        "0, 0, 0.5, 0.5, 20, 1000",
        "0, 0, 0.5, 0.5, 20, 20000",
        "0, 0, 0.5, 0.5, 20, 100000",
        "450, 300, 0.1, 0, 300, 10000",
        "3, 4, 0, -0.45, 600, 10000"
    })
    void drive_isAnArcOfRadiusSpeedOverTurnRate(
            double x, double y, double forwardMps, double turnRadps, int ticks, int stepMicros) {
        Pose start = new Pose(x, y, 0);
        World world = World.create(
                Specs.world(robot("r1", start)), WorldSettings.defaults().withPhysicsStepMicros(stepMicros));
        world.command(0, forwardMps, turnRadps);
        for (int tick = 1; tick <= ticks; tick++) {
            double angle = turnRadps * tick / 10;
            double radius = forwardMps / turnRadps;
            Pose end = start.compose(
                    turnRadps == 0
                            ? new Pose(forwardMps * tick / 10, 0, 0)
                            : new Pose(radius * StrictMath.sin(angle), radius * (1 - StrictMath.cos(angle)), angle));
            assertPose(run(world, 1).pose(), end.x(), end.y(), end.headingRad());
        }
    }

    @Test
    void turn_keepsTheCentreOfRotation_andStaysExactForTenThousandSeconds() {
        // from the centre of rotation the body reaches 0.18 m ahead and 0.26 m back
        World world = start(R1, wall("ahead", 1.5, 0, 1, 4), wall("behind", -2, 0, 1, 4));
        assertThat(first(world.latest()).wallGapM()).isCloseTo(1 - 0.18, EXACT);
        world.command(0, 0, StrictMath.PI / 2);
        RobotReading turned = run(world, 20);
        assertPose(turned.pose(), 0, 0, StrictMath.PI);
        assertThat(turned.wallGapM()).isCloseTo(1 - 0.26, EXACT);
        World slow = start(R1);
        slow.command(0, 0, 0.1);
        double headingRad = first(slow.advance(100_000)).pose().headingRad();
        assertThat(StrictMath.IEEEremainder(headingRad - 0.1 * 10_000, 2 * StrictMath.PI))
                .isCloseTo(0, within(1e-7));
    }

    @Test
    void newestCommand_winsAndHolds_forwardsAndBackwards() {
        World world = start(R1);
        world.command(0, 5, 5);
        world.command(0, 0.2, 0);
        run(world, 10);
        assertPose(run(world, 10).pose(), 0.4, 0, 0);
        world.stop(0);
        assertPose(run(world, 10).pose(), 0.4, 0, 0);
        world.command(0, -0.1, 0);
        assertPose(run(world, 20).pose(), 0.2, 0, 0);
    }

    @Test
    void velocityOfTheFile_isDrivenUntilACommand_andItsBoundsClampCommands() {
        World world = start("position ( velocity [ 0.5 0 0 0 ] )");
        assertThat(run(world, 10).pose().x()).isCloseTo(0.5, EXACT);
        world.stop(0);
        assertThat(run(world, 10).pose().x()).isCloseTo(0.5, EXACT);
        World bounded = start("position ( velocity_bounds [ -0.1 0.3 0 0 0 0 -10 45 ] )");
        bounded.command(0, 1, 5);
        Odometry reading = run(bounded, 1).odometry();
        assertThat(reading.forwardMps()).isEqualTo(0.3);
        assertThat(reading.turnRadps()).isCloseTo(Math.toRadians(45), within(1e-12));
        bounded.command(0, -1, -5);
        reading = run(bounded, 1).odometry();
        assertThat(reading.forwardMps()).isEqualTo(-0.1);
        assertThat(reading.turnRadps()).isCloseTo(Math.toRadians(-10), within(1e-12));
    }

    @Test
    void setOdometry_takesEffectAtTheNextInterval_andStartOdometryAtTheStart() {
        World world = driven(1, worldAt(1, 1, StrictMath.PI / 2));
        run(world, 10);
        world.setOdometry(0, new Pose(10, 20, StrictMath.PI));
        assertPose(first(world.latest()).odometry().pose(), 1, 0, 0);
        RobotReading reading = run(world, 10);
        assertPose(reading.odometry().pose(), 9, 20, StrictMath.PI);
        assertPose(reading.pose(), 1, 3, StrictMath.PI / 2);
        RobotSpec plain = robot("r1", 1, 2, 0.5);
        World global = start(Specs.with(plain, "startOdometry", plain.pose()));
        global.command(0, 0.5, 0.2);
        RobotReading globalReading = run(global, 37);
        Pose truth = globalReading.pose();
        assertPose(globalReading.odometry().pose(), truth.x(), truth.y(), truth.headingRad());
    }

    @Test
    void goTo_arrives_andTurnsToTheFinalHeading() {
        for (Pose goal : List.of(
                new Pose(2, 0, 1),
                new Pose(-1, 1.5, -2),
                new Pose(0, -3, 3.1),
                new Pose(0.5, 0.5, 0),
                new Pose(0, 0, 2))) {
            World world = worldAt(7, -3, 0.8); // the odometry frame begins there
            world.goTo(0, goal);
            Pose reported = run(world, 300).odometry().pose();
            assertThat(Math.abs(reported.x() - goal.x())).as("x of %s", goal).isLessThanOrEqualTo(0.02);
            assertThat(Math.abs(reported.y() - goal.y())).as("y of %s", goal).isLessThanOrEqualTo(0.02);
            assertThat(StrictMath.IEEEremainder(reported.headingRad() - goal.headingRad(), 2 * StrictMath.PI))
                    .as("heading of %s", goal)
                    .isCloseTo(0, within(0.001));
        }
    }

    @Test
    void goTo_drivesAtMost40CentimetresPerSecond_andTurnsBeforeItDrives_equallyFastToBothSides() {
        World world = start(R1);
        world.goTo(0, new Pose(0, 5, 0));
        Pose turning = run(world, 5).pose();
        assertThat(turning.headingRad()).as("1 rad/s at most").isCloseTo(0.5, EXACT);
        assertThat(turning.y()).isZero();
        double from = run(world, 40).pose().y();
        RobotReading driving = run(world, 10);
        assertThat(driving.pose().y() - from).isCloseTo(0.4, within(1e-3));
        assertThat(driving.odometry().forwardMps()).isEqualTo(0.4);

        World other = start(R1);
        other.goTo(0, new Pose(0, -5, 0));
        assertThat(run(other, 5).pose().headingRad()).isCloseTo(-0.5, EXACT);
    }

    @Test
    void goTo_isReplacedByASpeed_andSteerTurnsWhileItDrives() {
        World world = start(R1);
        world.goTo(0, new Pose(5, 0, 0));
        run(world, 5);
        world.command(0, 0, 0.5);
        assertThat(run(world, 10).odometry().forwardMps()).isZero();
        assertThat(run(world, 1).odometry().turnRadps()).isEqualTo(0.5);
        World steered = worldAt(0, 0, 1);
        steered.steer(0, 0.1, -0.5);
        RobotReading reading = run(steered, 200);
        assertThat(reading.odometry().pose().headingRad()).isCloseTo(-0.5, within(1e-6));
        assertThat(reading.odometry().forwardMps()).isEqualTo(0.1);
        assertThat(reading.pose().headingRad()).as("in the odometry frame").isCloseTo(0.5, within(1e-6));
    }

    @Test
    void robot_stopsWhenItsMotorsAreOff_orTheWatchdogHearsNothing() {
        World world = driven(0.5, start(R1));
        run(world, 2);
        world.motorPower(0, false);
        assertThat(run(world, 5).pose().x()).isCloseTo(0.1, EXACT);
        world.command(0, 0.5, 0);
        run(world, 1);
        world.motorPower(0, true);
        assertThat(run(world, 5).pose().x()).isCloseTo(0.1, EXACT);
        world.command(0, 0.5, 0);
        assertThat(run(world, 2).pose().x()).isCloseTo(0.2, EXACT);
        World watched = driven(
                0.2, World.create(Specs.world(R1), WorldSettings.defaults().withWatchdogMicros(500_000)));
        assertThat(run(watched, 20).pose().x()).isCloseTo(0.1, EXACT);
        for (int i = 0; i < 20; i++) {
            watched.command(0, 0.2, 0);
            run(watched, 1);
        }
        assertThat(first(watched.latest()).pose().x()).isCloseTo(0.5, EXACT);
        watched.goTo(0, new Pose(2, 0, 0));
        assertThat(run(watched, 100).pose().x()).as("a goal is not a speed").isCloseTo(2, within(0.02));
    }

    @Test
    void teleport_putsTheRobotThere_andItDrivesOn() {
        World world = driven(0.5, start(R1, wall("wall", 1.18, 0, 1, 4)));
        assertThat(run(world, 20).odometry().stalled()).isTrue();
        world.teleport(0, new Pose(-5, 3, StrictMath.PI / 2));
        RobotReading reading = run(world, 10);
        // the touch ends in the first step, which is as exact as the physics: single precision
        assertThat(reading.pose().x()).isCloseTo(-5, within(1e-6));
        assertThat(reading.pose().y()).isCloseTo(3.5, within(1e-6));
        assertThat(reading.odometry().stalled()).isFalse();
        assertThat(reading.odometry().pose()).as("exact odometry follows").isEqualTo(reading.pose());
    }

    @Test
    void teleport_intoSomething_orOfTwoRobotsToOnePlace_isRefused() {
        World world = start(List.of(R1, robot("r2", 0, 3, 0)), wall("wall", 3, 0, 1, 1));
        assertThatThrownBy(() -> world.teleport(0, new Pose(2.5, 0, 0)))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("robot 'r1' cannot be put at (2.5 m, 0.0 m, 0.0 rad): it would overlap obstacle 'wall'");
        assertThatThrownBy(() -> world.teleport(0, new Pose(0.2, 3.2, 1)))
                .hasMessageContaining("it would overlap robot 'r2'");
        assertThatThrownBy(() -> world.teleport(0, new Pose(Double.NaN, 0, 0))).hasMessageContaining("finite");
        assertThatThrownBy(() -> world.teleport(0, new Pose(501, 0, 0))).hasMessageContaining("at most 500.0 m");
        assertThat(run(world, 1).pose()).isEqualTo(Pose.ORIGIN);
        world.teleport(0, new Pose(0.1, 0.1, 0));
        assertThat(run(world, 1).pose())
                .as("where it stands itself there is room")
                .isEqualTo(new Pose(0.1, 0.1, 0));
        World two = start(List.of(R1, robot("r2", 0, 3, 0)));
        two.teleport(0, new Pose(5, 5, 0));
        two.teleport(1, new Pose(5, 5, 1));
        assertThat(two.advance().robots())
                .extracting(RobotReading::pose)
                .containsExactly(new Pose(5, 5, 0), new Pose(0, 3, 0));
    }

    // ---- cargo and other specifications of a world file

    private static final String SONAR = "ranger ( scount 1 spose[0] [ 0 0 0 ] sview [ 0 5 15 ] )";

    @Test
    void cargo_isSeenByOthersInItsOwnColour_andNotByItsRobot() {
        World world = start("position ( name \"eye\" " + SONAR + " blobfinder ( range 5 ) ) position ( name \"carrier\""
                + " pose [ 3 0 0 180 ] size [ 0.4 0.4 ] color \"black\" " + SONAR
                + " model ( pose [ 0.4 0 0 0 ] size [ 0.2 0.2 ] color \"blue\" ) )");
        RobotReading eye = first(world.latest());
        assertThat(eye.sonarM()).containsExactly(2.5);
        assertThat(eye.blobs().blobs()).extracting(ColourBlob::colour).contains(0x0000ff, 0x000000);
        // the other robot's sonar is behind its cargo and looks through it: the first robot's front is at 0.05
        assertThat(world.latest().robots().get(1).sonarM().getFirst()).isCloseTo(2.95, EXACT);
        world.command(1, -0.5, 0);
        assertThat(run(world, 10).sonarM().getFirst()).isCloseTo(3, EXACT);
    }

    @Test
    void obstacleReturnOfZero_letsRobotsAndCargoThroughWalls() {
        String robot = "model ( pose [ 2 0 0 0 ] size [ 0.2 2 ] ) position ( size [ 0.4 0.4 ]"
                + " model ( pose [ 0.4 0 0 0 ] size [ 0.2 0.2 ] obstacle_return %d ) )";
        // the wall begins at 1.9: cargo reaches 0.5 ahead, the body 0.2
        assertThat(run(driven(0.5, start(robot.formatted(1))), 60).pose().x()).isBetween(1.36, 1.4);
        assertThat(run(driven(0.5, start(robot.formatted(0))), 60).pose().x()).isBetween(1.66, 1.7);
        World world = start("position ( obstacle_return 0 size [ 0.4 0.4 ] ) position ( pose [ 0.1 0 0 0 ] )"
                + " model ( pose [ 1 0 0 0 ] size [ 0.2 2 ] )");
        world.command(0, 0.5, 0);
        assertThat(run(world, 40).pose().x()).isCloseTo(2, EXACT);
        assertThat(world.latest().contacts()).isEmpty();
        assertThat(world.latest().robots().get(1).pose().x()).isEqualTo(0.1);
    }

    @Test
    void wallWithABay_isSeenAtTheBaysBack() {
        RobotReading reading = first(start("position ( " + SONAR + " ) model ( pose [ 2 0 0 0 ] size [ 1 1 ] block ("
                        + " point[0] [ 0 0 ] point[1] [ 3 0 ] point[2] [ 3 3 ] point[3] [ 0 3 ] point[4] [ 0 2 ]"
                        + " point[5] [ 1 2 ] point[6] [ 1 1 ] point[7] [ 0 1 ] ) )")
                .latest());
        assertThat(reading.sonarM().getFirst()).as("into the bay").isCloseTo(1.5 + 1.0 / 3, EXACT);
    }
}
