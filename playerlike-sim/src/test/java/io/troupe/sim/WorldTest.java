package io.troupe.sim;

import static io.troupe.sim.TestWorlds.BLACK;
import static io.troupe.sim.TestWorlds.GREEN;
import static io.troupe.sim.TestWorlds.RED;
import static io.troupe.sim.TestWorlds.robot;
import static io.troupe.sim.TestWorlds.wall;
import static io.troupe.sim.TestWorlds.world;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.device.Blob;
import io.troupe.sim.scenario.BlobfinderSpec;
import io.troupe.sim.scenario.ObstacleSpec;
import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.RobotSpec;
import io.troupe.sim.scenario.WorldFileException;
import io.troupe.sim.scenario.WorldSpec;
import java.util.ArrayList;
import java.util.List;
import java.util.Objects;
import org.junit.jupiter.api.Test;

/** Small experiments whose results can be worked out by hand. */
class WorldTest {
    private static final double ROUNDING = 1e-9;

    private static World start(WorldSpec spec) {
        return World.create(spec, WorldSettings.DEFAULT);
    }

    private static Snapshot advance(World world, int ticks) {
        for (int tick = 0; tick < ticks; tick++) {
            world.advance();
        }
        return world.latest();
    }

    private static Pose pose(World world, int robot) {
        return world.latest().robots().get(robot).pose();
    }

    private static void assertPose(Pose actual, double x, double y, double headingRad) {
        assertThat(actual.x()).as("x").isCloseTo(x, within(ROUNDING));
        assertThat(actual.y()).as("y").isCloseTo(y, within(ROUNDING));
        assertThat(actual.headingRad()).as("heading").isCloseTo(headingRad, within(ROUNDING));
    }

    @Test
    void straightLine_isDrivenExactly() {
        World world = start(world(List.of(robot("r", -1, 0.5, 0))));
        world.command(0, 0.2, 0);
        advance(world, 100);
        assertPose(pose(world, 0), -1 + 0.2 * 10, 0.5, 0);
        assertThat(world.timeMicros()).isEqualTo(10_000_000);
    }

    @Test
    void circle_hasRadiusSpeedByTurnRate_andCloses() {
        World world = start(world(List.of(robot("r", 0, 0, 0))));
        double turn = StrictMath.PI / 10; // a full turn in 20 s
        world.command(0, 0.3, turn);
        advance(world, 50);
        double radius = 0.3 / turn;
        assertPose(pose(world, 0), radius, radius, StrictMath.PI / 2);
        advance(world, 150);
        assertThat(StrictMath.hypot(pose(world, 0).x(), pose(world, 0).y())).isLessThan(1e-8);
    }

    @Test
    void turningInPlace_leavesTheCentreOfRotationWhereItIs_evenIfItIsNotTheCentreOfTheBody() {
        RobotSpec plain = robot("r", 1, 2, 0);
        var shifted = new RobotSpec(
                plain.name(),
                plain.pose(),
                new io.troupe.sim.scenario.Shape(List.of(plain.shape().polygons().getFirst().stream()
                        .map(corner -> new io.troupe.sim.scenario.Point(corner.x() - 0.04, corner.y()))
                        .toList())),
                plain.colour(),
                0.4,
                0.3,
                23,
                new Pose(-0.04, 0, 0),
                Pose.ORIGIN,
                null,
                null,
                true,
                true,
                plain.where());
        World world = start(world(List.of(shifted)));
        world.command(0, 0, 0.5);
        advance(world, 40);
        assertPose(pose(world, 0), 1, 2, 2);
    }

    @Test
    void wall_stopsTheRobot_withOneContact_andAStall() {
        World world = start(world(List.of(robot("r", 0, 0, 0)), wall("east", 1.1, 0, 0.2, 4, BLACK)));
        world.command(0, 0.5, 0);
        var contacts = new ArrayList<Contact>();
        for (int tick = 0; tick < 50; tick++) {
            contacts.addAll(world.advance().contacts());
        }
        assertThat(contacts).singleElement().satisfies(contact -> {
            assertThat(contact.robot()).isZero();
            assertThat(contact.other()).isEqualTo("east");
            assertThat(contact.otherRobot()).isEqualTo(-1);
            assertThat(contact.timeMicros() / 1e6)
                    .isCloseTo((1.0 - 0.2) / 0.5, within(0.08)); // the front edge is 0.2 m ahead
        });
        RobotReading reading = world.latest().robots().getFirst();
        assertThat(reading.pose().x()).isCloseTo(0.8, within(0.021)); // bodies keep a skin of up to two centimetres
        assertThat(reading.wallGapM()).isBetween(0.0, 0.021);
        assertThat(reading.odometry().stalled()).isTrue();
        assertThat(reading.odometry().forwardMps()).isEqualTo(0.5);
        world.command(0, -0.2, 0);
        assertThat(advance(world, 5).robots().getFirst().odometry().stalled()).isFalse();
    }

    @Test
    void twoRobots_thatMeet_makeOneContact_ofTheLowerIndex() {
        World world = start(world(List.of(robot("a", -1, 0, 0), robot("b", 1, 0, StrictMath.PI))));
        world.command(0, 0.3, 0);
        world.command(1, 0.3, 0);
        var contacts = new ArrayList<Contact>();
        for (int tick = 0; tick < 40; tick++) {
            contacts.addAll(world.advance().contacts());
        }
        assertThat(contacts).singleElement().satisfies(contact -> {
            assertThat(contact.robot()).isZero();
            assertThat(contact.otherRobot()).isEqualTo(1);
            assertThat(contact.other()).isEqualTo("b");
        });
    }

    @Test
    void wallGap_isFromEdgeToEdge() {
        World world = start(
                world(List.of(robot("r", 0, 0, 0)), wall("corner", 0.2 + 0.3 + 0.5, 0.15 + 0.4 + 0.5, 1, 1, BLACK)));
        assertThat(world.latest().robots().getFirst().wallGapM()).isCloseTo(0.5, within(ROUNDING)); // 3, 4, 5
    }

    @Test
    void sonar_measuresToWallsAndOtherRobots_notToItself_andNotThroughAnything() {
        World world = start(world(
                List.of(robot("r", 0, 0, 0), robot("other", 0, 2, 0)),
                wall("east", 3.5, 0, 1, 1, BLACK),
                wall("far south", 0, -8, 1, 1, BLACK)));
        List<Double> sonar =
                Objects.requireNonNull(world.latest().robots().getFirst().sonarM());
        assertThat(sonar.get(0)).isCloseTo(2 - 0.15, within(ROUNDING));
        assertThat(sonar.get(1)).isCloseTo(3, within(ROUNDING));
        assertThat(sonar.get(2)).isEqualTo(5);
        assertThat(sonar.get(3)).isEqualTo(5);
    }

    @Test
    void sonar_atAnAngle_measuresAlongItsRay() {
        World world =
                start(world(List.of(robot("r", 0, 0, StrictMath.toRadians(30))), wall("east", 2.5, 0, 1, 9, BLACK)));
        assertThat(Objects.requireNonNull(world.latest().robots().getFirst().sonarM())
                        .get(1))
                .isCloseTo(2 / StrictMath.cos(StrictMath.toRadians(30)), within(ROUNDING));
    }

    @Test
    void blob_ofAKnownBox_coversItsColumns() {
        // a box whose near face is 2 m ahead, 1 m wide: seen under atan(1/4) = 14.04 degrees to both sides
        World world = start(world(List.of(robot("r", 0, 0, 0)), wall("box", 2.5, 0, 1, 1, RED)));
        Blob blob = Objects.requireNonNull(world.latest().robots().getFirst().blobs())
                .blobs()
                .getFirst();
        assertThat(blob.colour()).isEqualTo(RED);
        assertThat(blob.left()).isEqualTo(26); // column c looks 39.5 - c degrees to the left
        assertThat(blob.right()).isEqualTo(53);
        assertThat(blob.x()).isEqualTo(39);
        assertThat(blob.rangeM()).isCloseTo(2.02, within(0.01));
        assertThat(blob.areaPx2()).isEqualTo((53 - 26) * (blob.bottom() - blob.top()));
    }

    @Test
    void blob_isHiddenByWhatIsInFront_wallOrRobot() {
        World behindWall = start(world(
                List.of(robot("r", 0, 0, 0)), wall("box", 3, 0, 0.5, 0.5, RED), wall("screen", 1, 0, 0.1, 2, BLACK)));
        assertThat(colours(behindWall)).containsExactly(BLACK);
        World behindRobot = start(world(
                List.of(robot("r", 0, 0, 0), robot("other", 0.6, 0, StrictMath.PI / 2)),
                wall("box", 3, 0, 0.4, 0.4, RED)));
        assertThat(colours(behindRobot)).containsExactly(0xFFA500);
    }

    @Test
    void blobs_endWhereTheColourChanges_fromLeftToRight() {
        World world = start(world(
                List.of(robot("r", 0, 0, 0)),
                wall("left", 2, 0.3, 0.2, 0.6, GREEN),
                wall("right", 2, -0.3, 0.2, 0.6, RED)));
        assertThat(colours(world)).containsExactly(GREEN, RED);
    }

    @Test
    void cameraWithColours_reportsOnlyThose_butOthersStillHide() {
        RobotSpec plain = robot("r", 0, 0, 0);
        var choosy = new BlobfinderSpec(Pose.ORIGIN, 80, 60, 5, StrictMath.toRadians(80), List.of(RED));
        var robot = new RobotSpec(
                "r",
                plain.pose(),
                plain.shape(),
                plain.colour(),
                0.4,
                0.3,
                10,
                Pose.ORIGIN,
                Pose.ORIGIN,
                null,
                choosy,
                true,
                true,
                plain.where());
        World world =
                start(world(List.of(robot), wall("green", 1, 0, 0.1, 0.2, GREEN), wall("red", 2, 0, 0.1, 3, RED)));
        assertThat(colours(world)).containsExactly(RED, RED); // left and right of the green one
    }

    @Test
    void invisibleObstacle_isPassedByTheCamera_andTransparentOneByTheSonar() {
        ObstacleSpec glass = wall("glass", 1, 0, 0.1, 3, GREEN);
        var see = new ObstacleSpec(glass.name(), glass.pose(), glass.shape(), GREEN, true, false, false, glass.where());
        World world = start(world(List.of(robot("r", 0, 0, 0)), see, wall("red", 2.05, 0, 0.1, 3, RED)));
        assertThat(colours(world)).containsExactly(RED);
        assertThat(Objects.requireNonNull(world.latest().robots().getFirst().sonarM())
                        .get(1))
                .isCloseTo(2, within(ROUNDING));
    }

    @Test
    void odometry_countsFromTheStart_untilItIsSet() {
        World world = start(world(List.of(robot("r", 3, 4, StrictMath.PI / 2))));
        world.command(0, 0.5, 0);
        Pose before = advance(world, 20).robots().getFirst().odometry().pose();
        assertPose(before, 1, 0, 0);
        world.setOdometry(0, new Pose(10, 10, StrictMath.PI / 2));
        Pose after = advance(world, 20).robots().getFirst().odometry().pose();
        assertPose(after, 10, 11, StrictMath.PI / 2);
    }

    @Test
    void command_thatIsNotANumber_isRefused_andOneBeyondTheLimits_isLimited() {
        World world = start(world(List.of(robot("wheely", 0, 0, 0))));
        assertThatThrownBy(() -> world.command(0, Double.NaN, 0))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("'wheely' was told to drive at NaN m/s");
        world.command(0, 1e9, 0);
        assertThat(advance(world, 1).robots().getFirst().odometry().forwardMps())
                .isEqualTo(5);
    }

    @Test
    void interval_thatIsNoMultipleOfTheStep_isRefused() {
        var spec =
                new WorldSpec("odd", java.nio.file.Path.of("odd.world"), 25, List.of(robot("r", 0, 0, 0)), List.of());
        assertThatThrownBy(() -> start(spec))
                .hasMessageContaining("the interval of world 'odd' is 25000 us")
                .hasMessageContaining("10000 us");
    }

    @Test
    void advance_fromTwoThreads_isRefused() throws InterruptedException {
        World world = start(world(List.of(robot("r", 0, 0, 0))));
        world.advance();
        var refused = new Throwable[1];
        var thread = Thread.ofPlatform().start(() -> {
            try {
                world.advance();
            } catch (IllegalStateException e) {
                refused[0] = e;
            }
        });
        thread.join();
        assertThat(refused[0]).hasMessageContaining("advance() belongs to thread");
    }

    @Test
    void jitter_staysWithinItsBounds_dependsOnTheSeed_andNotOnOtherRobots() {
        WorldSpec one = world(List.of(robot("a", 0, 0, 0)));
        WorldSpec two = world(List.of(robot("a", 0, 0, 0), robot("b", 2, 0, 0)));
        var poses = new ArrayList<Pose>();
        for (long seed = 1; seed <= 50; seed++) {
            WorldSettings settings = WorldSettings.DEFAULT.withSeed(seed).withJitter(0.02, 0.03);
            Pose pose = pose(World.create(one, settings), 0);
            assertThat(StrictMath.abs(pose.x())).isLessThanOrEqualTo(0.02);
            assertThat(StrictMath.abs(pose.y())).isLessThanOrEqualTo(0.02);
            assertThat(StrictMath.abs(pose.headingRad())).isLessThanOrEqualTo(0.03);
            assertThat(pose(World.create(two, settings), 0)).isEqualTo(pose);
            assertThat(pose(World.create(two, settings), 1).y()).isNotEqualTo(pose.y());
            poses.add(pose);
        }
        assertThat(poses).doesNotHaveDuplicates();
    }

    @Test
    void startInsideAnObstacle_isRefused() {
        WorldSpec tight = world(List.of(robot("a", 0, 0, 0)), wall("all around", 0, 0, 5, 5, BLACK));
        assertThatThrownBy(() -> World.create(tight, WorldSettings.DEFAULT.withJitter(0.5, 3)))
                .isInstanceOf(WorldFileException.class)
                .hasMessageContaining("robot 'a' overlaps obstacle 'all around'");
    }

    @Test
    void sameCommands_sameSnapshots_bitForBit_evenInAPileUp() {
        assertThat(wander(7)).isEqualTo(wander(7));
        assertThat(wander(8)).isNotEqualTo(wander(7));
    }

    /** Robots that drive blindly into each other and the walls; every pose and every reading goes into the list. */
    private static List<Snapshot> wander(long seed) {
        var robots = new ArrayList<RobotSpec>();
        for (int index = 0; index < 9; index++) {
            robots.add(robot("r" + index, index % 3 - 1, index / 3 - 1, index));
        }
        World world = World.create(
                world(
                        robots,
                        wall("n", 0, 2, 5, 0.2, BLACK),
                        wall("s", 0, -2, 5, 0.2, RED),
                        wall("e", 2, 0, 0.2, 5, GREEN),
                        wall("w", -2, 0, 0.2, 5, BLACK)),
                WorldSettings.DEFAULT.withSeed(seed).withJitter(0.02, 0.03));
        var snapshots = new ArrayList<Snapshot>();
        for (int tick = 0; tick < 200; tick++) {
            for (int robot = 0; robot < robots.size(); robot++) {
                world.command(robot, 0.4, ((robot + tick / 20) % 3 - 1) * 0.5);
            }
            snapshots.add(world.advance());
        }
        return snapshots;
    }

    private static List<Integer> colours(World world) {
        return Objects.requireNonNull(world.latest().robots().getFirst().blobs()).blobs().stream()
                .map(Blob::colour)
                .toList();
    }
}
