package io.troupe.sim;

import static io.troupe.sim.Specs.BLACK;
import static io.troupe.sim.Specs.R1;
import static io.troupe.sim.Specs.driven;
import static io.troupe.sim.Specs.first;
import static io.troupe.sim.Specs.obstacle;
import static io.troupe.sim.Specs.robot;
import static io.troupe.sim.Specs.start;
import static io.troupe.sim.Specs.wall;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;
import static org.junit.jupiter.params.provider.Arguments.arguments;

import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.physics.Physics;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;
import java.util.function.BiFunction;
import java.util.stream.DoubleStream;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.Arguments;
import org.junit.jupiter.params.provider.MethodSource;
import org.junit.jupiter.params.provider.ValueSource;

/** Walls and robots are solid everywhere in the allowed range of a world, however the walls are specified. */
class CollisionTest {
    private static final WorldSettings FAST =
            WorldSettings.defaults().withPhysicsStepMicros(10_000).withLimits(5, 10);
    /** One and a half metres in a step. */
    private static final WorldSettings VERY_FAST =
            WorldSettings.defaults().withPhysicsStepMicros(100_000).withLimits(15, 1);

    private static final double MOST_GAP_M = Physics.SKIN_M + 1e-6; // the physics rounds
    private static final double FRONT_M = 0.18; // of a robot, from its centre of rotation

    private final List<Contact> contacts = new ArrayList<>();

    private Snapshot run(World world, int ticks) {
        for (int i = 0; i < ticks; i++) {
            contacts.addAll(world.advance().contacts());
        }
        return world.latest();
    }

    private boolean stalls(World world, int ticks) {
        return first(run(world, ticks)).odometry().stalled();
    }

    @Test
    void robotAgainstAWall_stops_touchesOnce_andStalls() {
        // front edge at 0.18, the wall's face at 1.18: one metre to go
        World world = driven(0.5, start(R1, wall("wall", 1.68, 0, 1, 4)));
        RobotReading before = first(run(world, 19));
        assertThat(before.odometry().stalled()).isFalse();
        assertThat(before.wallGapM()).isCloseTo(0.05, within(1e-9));
        RobotReading after = first(run(world, 31));

        assertThat(contacts).hasSize(1);
        // the skin is reached after 0.98 m, or 1.96 s, and the contact is reported in one of the next two steps
        long timeMicros = contacts.getFirst().timeMicros();
        assertThat(timeMicros).isBetween(1_960_000L, 1_980_000L);
        assertThat(contacts).containsExactly(new Contact(timeMicros, 0, "wall", -1));
        assertThat(after.odometry().stalled()).isTrue();
        assertThat(after.odometry().forwardMps()).isEqualTo(0.5);
        assertThat(after.wallGapM()).isBetween(0.0, MOST_GAP_M);
        assertThat(after.odometry().pose().x()).isCloseTo(1 - after.wallGapM(), within(1e-5));
        assertThat(after.pose().y()).isCloseTo(0, within(1e-3));
        assertThat(after.pose().headingRad()).isCloseTo(0, within(1e-3));
    }

    @Test
    void stall_endsWhenTheRobotStopsOrBacksAway_andTheNextTouchIsANewOne() {
        World world = driven(0.5, start(R1, wall("wall", 0.8, 0, 1, 4)));
        assertThat(stalls(world, 10)).isTrue();
        world.command(0, -0.5, 0);
        assertThat(stalls(world, 5)).isFalse();
        world.command(0, 0.5, 0);
        assertThat(stalls(world, 10)).isTrue();
        assertThat(contacts).extracting(Contact::other).containsExactly("wall", "wall");
        world.stop(0);
        assertThat(stalls(world, 5)).as("standing against a wall").isFalse();
    }

    @Test
    void turningAgainstAWall_isHeldBackToo() {
        // a channel 1 mm wider than the body, so that it cannot turn
        World world = start(R1, wall("left", 0, 0.6905, 4, 1), wall("right", 0, -0.6905, 4, 1));
        world.command(0, 0, 0.5);
        RobotReading reading = first(run(world, 10));
        assertThat(reading.odometry().stalled()).isTrue();
        assertThat(StrictMath.abs(reading.pose().headingRad())).isLessThan(0.1);
    }

    @Test
    void robotsThatMeet_giveOneContact_theLowerIndexFirst_andAnIdleOneIsPushed() {
        World world = driven(0.4, start(List.of(robot("left", -1, 0, 0), robot("right", 1, 0, StrictMath.PI))));
        Snapshot end = run(world, 40);
        assertThat(contacts).hasSize(1);
        // fronts are 2 - 2 * 0.18 apart and close at 0.8 m/s until the skins meet
        long timeMicros = contacts.getFirst().timeMicros();
        assertThat(timeMicros).isBetween(2_025_000L, 2_045_000L);
        assertThat(contacts).containsExactly(new Contact(timeMicros, 0, "right", 1));
        assertThat(end.robots()).allMatch(robot -> robot.odometry().stalled());
        assertThat(end.robots().get(1).pose().x() - first(end).pose().x() - 2 * FRONT_M)
                .isBetween(0.0, MOST_GAP_M);
        World idle = start(List.of(robot("pusher", 0, 0, 0), robot("pushed", 0.6, 0, 0)));
        idle.command(0, 0.4, 0);
        RobotReading pushed = run(idle, 50).robots().get(1);
        assertThat(pushed.pose().x()).isGreaterThan(0.7);
        assertThat(pushed.odometry().pose().x()).isCloseTo(pushed.pose().x() - 0.6, within(1e-9));
        assertThat(pushed.odometry().stalled()).isFalse();
    }

    @Test
    void wallOfSeveralPolygons_isTouchedOnce_andTouchesInOneStepAreOrderedByRobotThenObstacle() {
        List<List<Point>> pieces = new ArrayList<>();
        for (int i = -5; i < 5; i++) {
            pieces.add(square(1, i * 0.1, 1.2, i * 0.1 + 0.1));
        }
        World world = driven(0.5, start(R1, obstacle("fence", Pose.ORIGIN, new Shape(pieces), BLACK)));
        run(world, 30);
        assertThat(contacts).extracting(Contact::other).containsExactly("fence");
        contacts.clear();
        World two = driven(
                0.5,
                start(
                        List.of(robot("a", 0, 2, 0), robot("b", 0, 0, 0)),
                        wall("far", 1.18, 0.15, 1, 0.2),
                        wall("near", 1.18, -0.15, 1, 0.2),
                        wall("top", 1.18, 2, 1, 0.2)));
        run(two, 15);
        assertThat(contacts).extracting(Contact::other).containsExactly("top", "far", "near");
        assertThat(contacts)
                .extracting(Contact::timeMicros)
                .containsOnly(contacts.getFirst().timeMicros());
    }

    private static List<Point> square(double west, double south, double east, double north) {
        return List.of(new Point(west, south), new Point(east, south), new Point(east, north), new Point(west, north));
    }

    @Test
    void obstacleThatDoesNotBlockBodies_isDrivenThrough_andIsNoWall() {
        var line = new ObstacleSpec(
                "line", new Pose(1, 0, 0), Specs.box(0.1, 2), Specs.RED, false, true, true, Specs.at(3));
        World world = driven(0.5, start(R1, line));
        RobotReading end = first(run(world, 40));
        assertThat(end.pose().x()).isCloseTo(2, within(1e-9));
        assertThat(end.wallGapM()).isEqualTo(Double.POSITIVE_INFINITY);
        assertThat(contacts).isEmpty();
    }

    @Test
    void gap_isTheExactDistanceToTheNearestEdgeOrCorner() {
        // a square of side 1 turned by 45 degrees points a corner at the robot's front
        World world = start(R1, Specs.box("diamond", new Pose(2, 0.1, StrictMath.PI / 4), 1, 1, Specs.BLUE));
        assertThat(first(world.latest()).wallGapM()).isCloseTo(2 - StrictMath.sqrt(0.5) - FRONT_M, within(1e-12));
    }

    // ---- fast robots and thin walls

    @Test
    void fastRobot_passesNeitherAThinWall_whereverItStartsFrom_norAnotherRobot() {
        for (double x = -0.8; x < 4.8; x += 0.1) {
            World world =
                    driven(15, World.create(Specs.world(robot("r1", x, 0, 0), wall("thin", 5, 0, 0.01, 4)), VERY_FAST));
            RobotReading end = first(run(world, 20));
            assertThat(end.pose().x()).as("from %s", x).isLessThan(5 - FRONT_M);
            assertThat(end.odometry().stalled()).as("from %s", x).isTrue();
            assertThat(contacts).as("from %s", x).extracting(Contact::other).containsExactly("thin");
            contacts.clear();
        }
        World world = driven(
                15,
                World.create(
                        Specs.world(List.of(robot("left", -5, 0, 0), robot("right", 5, 0, StrictMath.PI))), VERY_FAST));
        Snapshot end = run(world, 20);
        assertThat(first(end).pose().x()).isLessThan(end.robots().get(1).pose().x());
        assertThat(contacts).hasSize(1);
    }

    /** A bar of 1 m x 1 cm at an angle in its own frame: its bounding box does not show how thin it is. */
    @Test
    void thinRobotThatStandsAslantInItsFrame_doesNotPassAThinWall() {
        RobotSpec upright = thinRobot(Pose.ORIGIN, Specs.box(0.01, 1));
        assertThat(PhysicsSetup.stepMicros(Specs.world(aslant(-1)), FAST))
                .as("step in which it moves")
                .isEqualTo(PhysicsSetup.stepMicros(Specs.world(upright), FAST));
        for (double x = -1.14; x < -1; x += 0.02) {
            ObstacleSpec wall = Specs.box("thin", new Pose(1, 0, StrictMath.PI / 4), 40, 0.001, BLACK);
            World world = driven(2, World.create(Specs.world(aslant(x), wall), FAST));
            Pose end = first(run(world, 30)).pose();
            assertThat(end.y()).as("from %s, on its side of y = x - 1", x).isGreaterThan(end.x() - 1);
        }
    }

    private static RobotSpec aslant(double x) {
        var frame = new Pose(0, 0, StrictMath.PI / 4);
        List<Point> bar = Specs.box(1, 0.01).polygons().getFirst().stream()
                .map(frame::place)
                .toList();
        return thinRobot(new Pose(x, 0, 0), new Shape(List.of(bar)));
    }

    private static RobotSpec thinRobot(Pose pose, Shape shape) {
        return Specs.with(Specs.with(robot("r1", pose), "origin", Pose.ORIGIN), "shape", shape);
    }

    /** The robots push one another at full speed; at these speeds they used to pass through walls. */
    @ParameterizedTest
    @ValueSource(doubles = {50, 100, 150, 199})
    void fastRobots_crushedInARoom_stayInIt(double speedMps) {
        List<RobotSpec> robots = List.of(
                robot("a", -1, 0, 0),
                robot("b", 0, 0, 1),
                robot("c", 1, 0, 2),
                robot("d", -1, 1, 3),
                robot("e", 0, 1, 4));
        for (long seed = 1; seed <= 5; seed++) {
            World world = World.create(
                    Specs.world(robots, Specs.arena(3)),
                    WorldSettings.defaults().withLimits(speedMps, 1));
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
                        .allSatisfy(
                                robot -> assertThat(awayM(robot, Pose.ORIGIN)).isLessThan(1.5));
            }
            assertThat(touches).isGreaterThan(20);
        }
    }

    /** The greater of the distances along x and along y. */
    private static double awayM(RobotReading robot, Pose from) {
        return StrictMath.max(
                StrictMath.abs(robot.pose().x() - from.x()),
                StrictMath.abs(robot.pose().y() - from.y()));
    }

    // ---- far from the origin

    private static final long SEED = 20_261_122;
    private static final double SIDE_M = 4; // inner side of a room
    private static final double THICK_M = 0.2;
    private static final double PIXEL_M = 0.1;
    private static final double NEAREST_M = 0.14; // of the centre of rotation to a wall: the rear is 0.26 away from it

    /** The ways to specify the four walls of a room around a point. */
    private enum Walls {
        /** Each wall is an obstacle with its pose in its middle. */
        BOXES((x, y) -> fourWalls(x, y, x, y, SIDE_M + 2 * THICK_M)),
        /** Each wall is very thin and slightly rotated. */
        THIN_AND_TURNED((x, y) -> IntStream.range(0, 4)
                .mapToObj(side -> new Pose(x, y, side * StrictMath.PI / 2 + 0.05))
                .map(frame ->
                        Specs.box("side", frame.compose(new Pose(SIDE_M / 2 + 0.2, 0, 0)), 0.001, SIDE_M + 1, BLACK))
                .toList()),
        /** All four are the pixels of one image in the room's middle. */
        BITMAP((x, y) -> List.of(obstacle("cave", new Pose(x, y, 0), pixels(0, 0), BLACK))),
        /** The same image, in an obstacle whose pose is the origin. */
        BITMAP_FAR_FROM_ITS_POSE((x, y) -> List.of(obstacle("cave", Pose.ORIGIN, pixels(x, y), BLACK))),
        /** Walls that extend through the whole world. */
        LONG((x, y) -> fourWalls(x, y, 0, 0, 998));

        private final BiFunction<Double, Double, List<ObstacleSpec>> around;

        Walls(BiFunction<Double, Double, List<ObstacleSpec>> around) {
            this.around = around;
        }
    }

    private static List<ObstacleSpec> fourWalls(double x, double y, double middleX, double middleY, double lengthM) {
        double out = SIDE_M / 2 + THICK_M / 2;
        return List.of(
                wall("east", x + out, middleY, THICK_M, lengthM),
                wall("north", middleX, y + out, lengthM, THICK_M),
                wall("west", x - out, middleY, THICK_M, lengthM),
                wall("south", middleX, y - out, lengthM, THICK_M));
    }

    /** A ring of small squares. */
    private static Shape pixels(double x, double y) {
        var pieces = new ArrayList<List<Point>>();
        int half = (int) StrictMath.rint((SIDE_M / 2 + THICK_M) / PIXEL_M);
        int inner = (int) StrictMath.rint(SIDE_M / 2 / PIXEL_M);
        for (int i = -half; i < half; i++) {
            for (int j = -half; j < half; j++) {
                if (i < -inner || i >= inner || j < -inner || j >= inner) {
                    pieces.add(square(x + i * PIXEL_M, y + j * PIXEL_M, x + (i + 1) * PIXEL_M, y + (j + 1) * PIXEL_M));
                }
            }
        }
        return new Shape(pieces);
    }

    private static List<Pose> quadrants(double awayM) {
        return awayM == 0
                ? List.of(Pose.ORIGIN)
                : List.of(
                        new Pose(awayM, awayM, 0),
                        new Pose(-awayM, awayM, 0),
                        new Pose(-awayM, -awayM, 0),
                        new Pose(awayM, -awayM, 0));
    }

    /** Three robots in a room push, turn and rub along the walls. */
    @ParameterizedTest
    @MethodSource("rooms")
    void walls_hold(Walls walls, Pose middle) {
        List<RobotSpec> robots = List.of(
                robot("a", middle.x() - 1, middle.y() - 1, 1),
                robot("b", middle.x() + 1, middle.y() - 1, 2),
                robot("c", middle.x(), middle.y() + 1, 3));
        World world =
                World.create(Specs.world(robots, walls.around.apply(middle.x(), middle.y())), WorldSettings.defaults());
        double mostM = walls == Walls.THIN_AND_TURNED ? SIDE_M / 2 + 0.3 : SIDE_M / 2 - NEAREST_M;
        var random = new SplittableRandom(SEED);
        int touches = 0;
        for (int tick = 0; tick < 200; tick++) {
            for (int robot = 0; robot < 3; robot++) {
                if (random.nextInt(25) == 0) {
                    world.command(robot, random.nextInt(4) == 0 ? -1 : 1, random.nextDouble(-0.6, 0.6));
                }
            }
            Snapshot now = world.advance();
            touches += now.contacts().size();
            for (RobotReading robot : now.robots()) {
                int at = tick;
                assertThat(awayM(robot, middle))
                        .as(() -> "seed %d, tick %d: %s".formatted(SEED, at, robot.pose()))
                        .isLessThan(mostM);
            }
        }
        assertThat(touches).as("seed %d", SEED).isGreaterThan(5);
    }

    static Stream<Arguments> rooms() {
        return Stream.of(Walls.values())
                .flatMap(walls -> DoubleStream.of(0, 13, 250, 300, 490)
                        .boxed()
                        .flatMap(awayM -> quadrants(awayM).stream())
                        .map(middle -> arguments(walls, middle)));
    }

    @ParameterizedTest
    @ValueSource(doubles = {0, 250, 300, 490})
    void robotsThatMeet_holdEachOther(double distanceM) {
        for (Pose middle : quadrants(distanceM)) {
            for (double headingRad = 0; headingRad < 3.1; headingRad += 0.5) {
                Pose line = new Pose(middle.x(), middle.y(), headingRad);
                Point left = line.place(new Point(-1, 0));
                Point right = line.place(new Point(1, 0));
                World world = driven(
                        0.5,
                        start(List.of(
                                robot("left", left.x(), left.y(), headingRad),
                                robot("right", right.x(), right.y(), headingRad + StrictMath.PI))));
                Snapshot end = world.advance(100);
                Pose one = first(end).pose();
                Pose other = end.robots().get(1).pose();
                assertThat(StrictMath.hypot(other.x() - one.x(), other.y() - one.y()))
                        .as("%s", line)
                        .isBetween(2 * FRONT_M, 2 * FRONT_M + 2 * 0.02);
            }
        }
    }

    @ParameterizedTest
    @ValueSource(doubles = {0, 250, 300, 490})
    void robotThatRubsAlongAWall_staysBesideIt(double distanceM) {
        for (Pose middle : quadrants(distanceM)) {
            // the wall's side is 1 m north, and 9 m long
            World world = start(
                    robot("r", middle.x() - 4, middle.y() + 0.7, 0.2),
                    wall("wall", middle.x(), middle.y() + 1.05, 9, 0.1));
            boolean touched = false;
            for (int tick = 0; tick < 100; tick++) {
                world.command(0, 0.5, 0.2);
                Snapshot now = world.advance();
                touched |= !now.contacts().isEmpty();
                assertThat(first(now).pose().y())
                        .as("tick %d around %s", tick, middle)
                        .isLessThan(middle.y() + 1 - 0.15);
            }
            assertThat(touched).isTrue();
        }
    }
}
