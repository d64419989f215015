package io.troupe.sim;

import static io.troupe.sim.Specs.BLACK;
import static io.troupe.sim.Specs.at;
import static io.troupe.sim.Specs.robot;
import static io.troupe.sim.Specs.wall;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.WorldSpec;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;
import org.junit.jupiter.params.provider.ValueSource;

/** Walls and robots are solid everywhere in the allowed range of a world, however the walls are specified. */
class FarCollisionTest {
    private static final long SEED = 20_261_122;
    private static final double SIDE_M = 4; // inner side of a room
    private static final double THICK_M = 0.2;
    private static final double PIXEL_M = 0.1;
    private static final double NEAREST_M =
            0.14; // distance of the centre of rotation from a wall: the rear edge is 0.26 away from it

    /** The ways to specify the four walls of a room. */
    private enum Walls {
        /** Each wall is an obstacle with its pose in its middle. */
        BOXES {
            @Override
            List<ObstacleSpec> around(double x, double y) {
                double out = SIDE_M / 2 + THICK_M / 2;
                double length = SIDE_M + 2 * THICK_M;
                return List.of(
                        wall("east", x + out, y, THICK_M, length),
                        wall("north", x, y + out, length, THICK_M),
                        wall("west", x - out, y, THICK_M, length),
                        wall("south", x, y - out, length, THICK_M));
            }
        },
        /** Each wall is very thin and slightly rotated. */
        THIN_AND_TURNED {
            @Override
            List<ObstacleSpec> around(double x, double y) {
                var walls = new ArrayList<ObstacleSpec>();
                for (int side = 0; side < 4; side++) {
                    double headingRad = side * StrictMath.PI / 2 + 0.05;
                    Point middle = new Pose(x, y, headingRad).place(new Point(SIDE_M / 2 + 0.2, 0));
                    walls.add(Specs.box(
                            "side " + side, new Pose(middle.x(), middle.y(), headingRad), 0.001, SIDE_M + 1, BLACK));
                }
                return walls;
            }
        },
        /** All four are the pixels of one image in the room's middle. */
        BITMAP {
            @Override
            List<ObstacleSpec> around(double x, double y) {
                return List.of(
                        new ObstacleSpec("cave", new Pose(x, y, 0), pixels(0, 0), BLACK, true, true, true, at(2)));
            }
        },
        /** The same image, in an obstacle whose pose is the origin. */
        BITMAP_FAR_FROM_ITS_POSE {
            @Override
            List<ObstacleSpec> around(double x, double y) {
                return List.of(new ObstacleSpec("cave", Pose.ORIGIN, pixels(x, y), BLACK, true, true, true, at(2)));
            }
        },
        /** Walls that extend through the whole world. */
        LONG {
            @Override
            List<ObstacleSpec> around(double x, double y) {
                double out = SIDE_M / 2 + THICK_M / 2;
                return List.of(
                        wall("east", x + out, 0, THICK_M, 998),
                        wall("north", 0, y + out, 998, THICK_M),
                        wall("west", x - out, 0, THICK_M, 998),
                        wall("south", 0, y - out, 998, THICK_M));
            }
        };

        abstract List<ObstacleSpec> around(double x, double y);
    }

    /** A ring of small squares. */
    private static Shape pixels(double x, double y) {
        var pieces = new ArrayList<List<Point>>();
        int half = (int) StrictMath.rint((SIDE_M / 2 + THICK_M) / PIXEL_M);
        int inner = (int) StrictMath.rint(SIDE_M / 2 / PIXEL_M);
        for (int i = -half; i < half; i++) {
            for (int j = -half; j < half; j++) {
                if (i < -inner || i >= inner || j < -inner || j >= inner) {
                    double west = x + i * PIXEL_M;
                    double south = y + j * PIXEL_M;
                    double east = x + (i + 1) * PIXEL_M;
                    double north = y + (j + 1) * PIXEL_M;
                    pieces.add(List.of(
                            new Point(west, south),
                            new Point(east, south),
                            new Point(east, north),
                            new Point(west, north)));
                }
            }
        }
        return new Shape(pieces);
    }

    private static List<Pose> quadrants(double distanceM) {
        return distanceM == 0
                ? List.of(Pose.ORIGIN)
                : List.of(
                        new Pose(distanceM, distanceM, 0),
                        new Pose(-distanceM, distanceM, 0),
                        new Pose(-distanceM, -distanceM, 0),
                        new Pose(distanceM, -distanceM, 0));
    }

    /** Drives three robots in a room, which push, turn and rub along the walls. */
    private static void driveInARoom(Walls walls, Pose middle) {
        String what = walls + " around " + middle + ", seed " + SEED;
        List<RobotSpec> robots = List.of(
                robot("a", new Pose(middle.x() - 1, middle.y() - 1, 1)),
                robot("b", new Pose(middle.x() + 1, middle.y() - 1, 2)),
                robot("c", new Pose(middle.x(), middle.y() + 1, 3)));
        WorldSpec spec = Specs.world(robots, walls.around(middle.x(), middle.y()));
        World world = World.create(spec, WorldSettings.DEFAULT);
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
                double away = StrictMath.max(
                        StrictMath.abs(robot.pose().x() - middle.x()),
                        StrictMath.abs(robot.pose().y() - middle.y()));
                double most = walls == Walls.THIN_AND_TURNED ? SIDE_M / 2 + 0.3 : SIDE_M / 2 - NEAREST_M;
                assertThat(away).as("%s, tick %d: %s", what, tick, robot.pose()).isLessThan(most);
            }
        }
        assertThat(touches).as(what).isGreaterThan(5);
    }

    @ParameterizedTest
    @EnumSource
    void walls_holdAtTheOrigin(Walls walls) {
        quadrants(0).forEach(middle -> driveInARoom(walls, middle));
    }

    @ParameterizedTest
    @EnumSource
    void walls_hold13MetresOut(Walls walls) {
        quadrants(13).forEach(middle -> driveInARoom(walls, middle));
    }

    @ParameterizedTest
    @EnumSource
    void walls_hold250MetresOut(Walls walls) {
        quadrants(250).forEach(middle -> driveInARoom(walls, middle));
    }

    @ParameterizedTest
    @EnumSource
    void walls_hold300MetresOut(Walls walls) {
        quadrants(300).forEach(middle -> driveInARoom(walls, middle));
    }

    @ParameterizedTest
    @EnumSource
    void walls_hold490MetresOut(Walls walls) {
        quadrants(490).forEach(middle -> driveInARoom(walls, middle));
    }

    @ParameterizedTest
    @ValueSource(doubles = {0, 250, 300, 490})
    void robotsThatMeet_holdEachOther(double distanceM) {
        for (Pose middle : quadrants(distanceM)) {
            for (double headingRad = 0; headingRad < 3.1; headingRad += 0.5) {
                Pose line = new Pose(middle.x(), middle.y(), headingRad);
                Point left = line.place(new Point(-1, 0));
                Point right = line.place(new Point(1, 0));
                World world = World.create(
                        Specs.world(List.of(
                                robot("left", new Pose(left.x(), left.y(), headingRad)),
                                robot("right", new Pose(right.x(), right.y(), headingRad + StrictMath.PI)))),
                        WorldSettings.DEFAULT);
                world.command(0, 0.5, 0);
                world.command(1, 0.5, 0);

                Snapshot end = world.advance(100);

                Pose first = end.robots().get(0).pose();
                Pose second = end.robots().get(1).pose();
                assertThat(StrictMath.hypot(second.x() - first.x(), second.y() - first.y()))
                        .as("%s", line)
                        .isBetween(0.36, 0.36 + 2 * 0.02);
            }
        }
    }

    @ParameterizedTest
    @ValueSource(doubles = {0, 250, 300, 490})
    void robotThatRubsAlongAWall_staysBesideIt(double distanceM) {
        for (Pose middle : quadrants(distanceM)) {
            // the wall's side is 1 m north, and 9 m long
            WorldSpec spec = Specs.world(
                    robot("r", new Pose(middle.x() - 4, middle.y() + 0.7, 0.2)),
                    wall("wall", middle.x(), middle.y() + 1.05, 9, 0.1));
            World world = World.create(spec, WorldSettings.DEFAULT);
            boolean touched = false;
            for (int tick = 0; tick < 100; tick++) {
                world.command(0, 0.5, 0.2);
                Snapshot now = world.advance();
                touched |= !now.contacts().isEmpty();
                assertThat(now.robots().getFirst().pose().y())
                        .as("tick %d around %s", tick, middle)
                        .isLessThan(middle.y() + 1 - 0.15);
            }
            assertThat(touched).isTrue();
        }
    }
}
