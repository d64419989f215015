package io.troupe.sim;

import static io.troupe.sim.Specs.robot;
import static io.troupe.sim.Specs.wall;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.physics.Physics;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class CollisionTest {
    private static final WorldSettings FAST =
            WorldSettings.DEFAULT.withPhysicsStepMicros(10_000).withLimits(5, 10);
    private static final double MOST_GAP_M = Physics.SKIN_M + 1e-6; // the physics rounds

    private final List<Contact> contacts = new ArrayList<>();

    private Snapshot run(World world, int ticks) {
        for (int i = 0; i < ticks; i++) {
            contacts.addAll(world.advance().contacts());
        }
        return world.latest();
    }

    @Test
    void robotAgainstAWall_stops_touchesOnce_andStalls() {
        // front edge at 0.18, the wall's face at 1.18: one metre to go
        World world =
                World.create(Specs.world(robot("r1", Pose.ORIGIN), wall("wall", 1.68, 0, 1, 4)), WorldSettings.DEFAULT);
        world.command(0, 0.5, 0);

        RobotReading before = run(world, 19).robots().getFirst();
        assertThat(before.odometry().stalled()).isFalse();
        assertThat(before.wallGapM()).isCloseTo(0.05, within(1e-9));
        RobotReading after = run(world, 31).robots().getFirst();

        assertThat(contacts).hasSize(1);
        Contact contact = contacts.getFirst();
        assertThat(contact.robot()).isZero();
        assertThat(contact.other()).isEqualTo("wall");
        assertThat(contact.otherRobot()).isEqualTo(-1);
        // the skin is reached after 0.98 m, or 1.96 s, and the contact is reported in one of the next two steps
        assertThat(contact.timeMicros()).isBetween(1_960_000L, 1_980_000L);
        assertThat(after.odometry().stalled()).isTrue();
        assertThat(after.odometry().forwardMps()).isEqualTo(0.5);
        assertThat(after.wallGapM()).isBetween(0.0, MOST_GAP_M);
        assertThat(after.odometry().pose().x()).isCloseTo(1 - after.wallGapM(), within(1e-5));
        assertThat(after.pose().y()).isCloseTo(0, within(1e-3));
        assertThat(after.pose().headingRad()).isCloseTo(0, within(1e-3));
    }

    @Test
    void stall_endsWhenTheRobotBacksAway_andTheNextTouchIsANewOne() {
        World world =
                World.create(Specs.world(robot("r1", Pose.ORIGIN), wall("wall", 0.8, 0, 1, 4)), WorldSettings.DEFAULT);
        world.command(0, 0.5, 0);
        assertThat(run(world, 10).robots().getFirst().odometry().stalled()).isTrue();

        world.command(0, -0.5, 0);
        assertThat(run(world, 5).robots().getFirst().odometry().stalled()).isFalse();
        world.command(0, 0.5, 0);
        run(world, 10);

        assertThat(contacts).extracting(Contact::other).containsExactly("wall", "wall");
    }

    @Test
    void standingAgainstAWall_isNoStall() {
        World world =
                World.create(Specs.world(robot("r1", Pose.ORIGIN), wall("wall", 0.8, 0, 1, 4)), WorldSettings.DEFAULT);
        world.command(0, 0.5, 0);
        run(world, 10);
        world.stop(0);

        assertThat(run(world, 5).robots().getFirst().odometry().stalled()).isFalse();
    }

    @Test
    void turningAgainstAWall_isHeldBackToo() {
        // a channel 1 mm wider than the body, so that it cannot turn
        World world = World.create(
                Specs.world(robot("r1", Pose.ORIGIN), wall("left", 0, 0.6905, 4, 1), wall("right", 0, -0.6905, 4, 1)),
                WorldSettings.DEFAULT);
        world.command(0, 0, 0.5);

        RobotReading reading = run(world, 10).robots().getFirst();

        assertThat(reading.odometry().stalled()).isTrue();
        assertThat(StrictMath.abs(reading.pose().headingRad())).isLessThan(0.1);
    }

    @Test
    void robotsThatMeet_giveOneContact_theLowerIndexFirst() {
        World world = World.create(
                Specs.world(List.of(robot("left", new Pose(-1, 0, 0)), robot("right", new Pose(1, 0, StrictMath.PI)))),
                WorldSettings.DEFAULT);
        world.command(0, 0.4, 0);
        world.command(1, 0.4, 0);

        Snapshot end = run(world, 40);

        assertThat(contacts).hasSize(1);
        assertThat(contacts.getFirst().robot()).isZero();
        assertThat(contacts.getFirst().otherRobot()).isEqualTo(1);
        assertThat(contacts.getFirst().other()).isEqualTo("right");
        // fronts are 2 - 2 * 0.18 apart and close at 0.8 m/s until the skins meet
        assertThat(contacts.getFirst().timeMicros()).isBetween(2_025_000L, 2_045_000L);
        assertThat(end.robots())
                .allSatisfy(robot -> assertThat(robot.odometry().stalled()).isTrue());
        double gap = end.robots().get(1).pose().x() - end.robots().get(0).pose().x() - 2 * 0.18;
        assertThat(gap).isBetween(0.0, MOST_GAP_M);
    }

    @Test
    void wallOfSeveralPolygons_isTouchedOnce() {
        List<List<Point>> pieces = new ArrayList<>();
        for (int i = -5; i < 5; i++) {
            double y = i * 0.1;
            pieces.add(List.of(new Point(1, y), new Point(1.2, y), new Point(1.2, y + 0.1), new Point(1, y + 0.1)));
        }
        var fence =
                new ObstacleSpec("fence", Pose.ORIGIN, new Shape(pieces), Specs.BLACK, true, true, true, Specs.at(3));
        World world = World.create(Specs.world(robot("r1", Pose.ORIGIN), fence), WorldSettings.DEFAULT);
        world.command(0, 0.5, 0);

        run(world, 30);

        assertThat(contacts).extracting(Contact::other).containsExactly("fence");
    }

    @Test
    void touchesInOneStep_areOrderedByRobotThenObstacle() {
        World world = World.create(
                Specs.world(
                        List.of(robot("a", new Pose(0, 2, 0)), robot("b", new Pose(0, 0, 0))),
                        wall("far", 1.18, 0.15, 1, 0.2),
                        wall("near", 1.18, -0.15, 1, 0.2),
                        wall("top", 1.18, 2, 1, 0.2)),
                WorldSettings.DEFAULT);
        world.command(0, 0.5, 0);
        world.command(1, 0.5, 0);

        run(world, 15);

        assertThat(contacts).extracting(Contact::other).containsExactly("top", "far", "near");
        assertThat(contacts)
                .extracting(Contact::timeMicros)
                .containsOnly(contacts.getFirst().timeMicros());
    }

    @Test
    void obstacleThatDoesNotBlockBodies_isDrivenThrough_andIsNoWall() {
        ObstacleSpec line = new ObstacleSpec(
                "line", new Pose(1, 0, 0), Specs.box(0.1, 2, 0), Specs.RED, false, true, true, Specs.at(3));
        World world = World.create(Specs.world(robot("r1", Pose.ORIGIN), line), WorldSettings.DEFAULT);
        world.command(0, 0.5, 0);

        RobotReading end = run(world, 40).robots().getFirst();

        assertThat(end.pose().x()).isCloseTo(2, within(1e-9));
        assertThat(end.wallGapM()).isEqualTo(Double.POSITIVE_INFINITY);
        assertThat(contacts).isEmpty();
    }

    @Test
    void fastRobot_doesNotPassAThinWall_whereverItStartsFrom() {
        // 1.5 m in one step, the wall 1 cm thick
        for (double x = -0.8; x < 4.8; x += 0.1) {
            World world = World.create(
                    Specs.world(robot("r1", new Pose(x, 0, 0)), wall("thin", 5, 0, 0.01, 4)),
                    WorldSettings.DEFAULT.withPhysicsStepMicros(100_000).withLimits(15, 1));
            world.command(0, 15, 0);

            Snapshot end = run(world, 20);

            assertThat(end.robots().getFirst().pose().x()).as("from %s", x).isLessThan(5 - 0.18);
            assertThat(end.robots().getFirst().odometry().stalled())
                    .as("from %s", x)
                    .isTrue();
            assertThat(contacts).as("from %s", x).extracting(Contact::other).containsExactly("thin");
            contacts.clear();
        }
    }

    /** A bar of 1 m x 1 cm at an angle in its own frame: its bounding box does not show how thin it is. */
    @Test
    void thinRobotThatStandsAslantInItsFrame_doesNotPassAThinWall() {
        RobotSpec thin = aslant(new Pose(-1, 0, 0));
        RobotSpec upright = withShape(robot("r1", Pose.ORIGIN), Specs.box(0.01, 1, 0));
        assertThat(PhysicsSetup.stepMicros(Specs.world(thin), FAST))
                .as("step in which it moves")
                .isEqualTo(PhysicsSetup.stepMicros(Specs.world(upright), FAST));
        for (double x = -1.14; x < -1; x += 0.02) {
            ObstacleSpec wall = Specs.box("thin", new Pose(1, 0, StrictMath.PI / 4), 40, 0.001, Specs.BLACK);
            World world = World.create(Specs.world(aslant(new Pose(x, 0, 0)), wall), FAST);
            world.command(0, 2, 0);

            Pose end = run(world, 30).robots().getFirst().pose();

            assertThat(end.y()).as("from %s, on its side of y = x - 1", x).isGreaterThan(end.x() - 1);
        }
    }

    private static RobotSpec aslant(Pose pose) {
        var frame = new Pose(0, 0, StrictMath.PI / 4);
        List<Point> bar = Specs.box(1, 0.01, 0).polygons().getFirst().stream()
                .map(frame::place)
                .toList();
        return withShape(robot("r1", pose), new Shape(List.of(bar)));
    }

    private static RobotSpec withShape(RobotSpec robot, Shape shape) {
        return new RobotSpec(
                robot.name(),
                robot.pose(),
                shape,
                robot.colour(),
                1,
                1,
                robot.massKg(),
                Pose.ORIGIN,
                Pose.ORIGIN,
                null,
                null,
                List.of(),
                true,
                true,
                Specs.at(7));
    }

    @Test
    void fastRobot_doesNotPassAnother() {
        World world = World.create(
                Specs.world(List.of(robot("left", new Pose(-5, 0, 0)), robot("right", new Pose(5, 0, StrictMath.PI)))),
                WorldSettings.DEFAULT.withPhysicsStepMicros(100_000).withLimits(15, 1));
        world.command(0, 15, 0);
        world.command(1, 15, 0);

        Snapshot end = run(world, 20);

        assertThat(end.robots().get(0).pose().x())
                .isLessThan(end.robots().get(1).pose().x());
        assertThat(contacts).hasSize(1);
    }

    /** The robots push one another at full speed; at these speeds they used to pass through walls. */
    @ParameterizedTest
    @ValueSource(doubles = {50, 100, 150, 199})
    void fastRobots_crushedInARoom_stayInIt(double speedMps) {
        for (long seed = 1; seed <= 5; seed++) {
            World world = World.create(
                    Specs.world(
                            List.of(
                                    robot("a", new Pose(-1, 0, 0)),
                                    robot("b", new Pose(0, 0, 1)),
                                    robot("c", new Pose(1, 0, 2)),
                                    robot("d", new Pose(-1, 1, 3)),
                                    robot("e", new Pose(0, 1, 4))),
                            Specs.arena(3)),
                    WorldSettings.DEFAULT.withLimits(speedMps, 1));
            var random = new SplittableRandom(seed);
            int touches = 0;
            for (int tick = 0; tick < 60; tick++) {
                for (int robot = 0; robot < 5; robot++) {
                    if (random.nextInt(4) == 0) {
                        world.command(robot, random.nextDouble(-speedMps, speedMps), random.nextDouble(-1, 1));
                    }
                }
                Snapshot now = world.advance();
                touches += now.contacts().size();
                assertThat(now.robots())
                        .as("seed %d, tick %d", seed, tick)
                        .allSatisfy(robot -> assertThat(StrictMath.max(
                                        StrictMath.abs(robot.pose().x()),
                                        StrictMath.abs(robot.pose().y())))
                                .isLessThan(1.5));
            }
            assertThat(touches).isGreaterThan(20);
        }
    }

    @Test
    void robotDrivenAgainstAnother_pushesIt() {
        World world = World.create(
                Specs.world(List.of(robot("pusher", new Pose(0, 0, 0)), robot("pushed", new Pose(0.6, 0, 0)))),
                WorldSettings.DEFAULT);
        world.command(0, 0.4, 0);

        Snapshot end = run(world, 50);

        RobotReading pushed = end.robots().get(1);
        assertThat(pushed.pose().x()).isGreaterThan(0.7);
        assertThat(pushed.odometry().pose().x()).isCloseTo(pushed.pose().x() - 0.6, within(1e-9));
        assertThat(pushed.odometry().stalled()).isFalse();
    }

    @Test
    void gap_isTheExactDistanceToTheNearestEdgeOrCorner() {
        // a square of side 1 turned by 45 degrees points a corner at the robot's front
        ObstacleSpec diamond = Specs.box("diamond", new Pose(2, 0.1, StrictMath.PI / 4), 1, 1, Specs.BLUE);
        World world = World.create(Specs.world(robot("r1", Pose.ORIGIN), diamond), WorldSettings.DEFAULT);

        assertThat(world.latest().robots().getFirst().wallGapM())
                .isCloseTo(2 - StrictMath.sqrt(0.5) - 0.18, within(1e-12));
    }
}
