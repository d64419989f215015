package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.model.WorldSpec;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;
import java.util.function.UnaryOperator;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * Random arenas, mazes, offices and caves, with robots at random free places.
 *
 * <p><b>Role.</b> Worlds to learn and to tune in. The same arguments give the same world, on every machine.
 *
 * <p><b>Units and shapes.</b> Metres; the middle of the world is the origin, walls are 0.2 m thick. A robot is a
 * Pioneer with sixteen sonars, 0.44 m long and 0.38 m wide, and has no other devices.
 *
 * <p><b>Errors.</b> {@link IllegalArgumentException} for a size that makes no world, and for more robots than found a
 * place.
 */
public final class RandomWorld {
    private static final int WALL = 0x404040;
    private static final int BOX = 0x806040;
    private static final int ROBOT = 0xFFA500;
    private static final double WALL_M = 0.2;
    private static final double FREE_M = 0.45; // around the centre of a robot
    private static final double DEGREE = StrictMath.PI / 180;
    private static final int MOST_TRIES = 20_000;
    private static final Path FILE = Path.of("random.world");

    private static final double[][] PIONEER_SONARS = { // x, y, heading in degrees
        {0.075, 0.130, 90}, {0.115, 0.115, 50}, {0.150, 0.080, 30}, {0.170, 0.025, 10},
        {0.170, -0.025, -10}, {0.150, -0.080, -30}, {0.115, -0.115, -50}, {0.075, -0.130, -90},
        {-0.155, -0.130, -90}, {-0.195, -0.115, -130}, {-0.230, -0.080, -150}, {-0.250, -0.025, -170},
        {-0.250, 0.025, 170}, {-0.230, 0.080, 150}, {-0.195, 0.115, 130}, {-0.155, 0.130, 90}
    };

    private final String name;
    private final double halfX;
    private final double halfY;
    private final SplittableRandom random;
    private final List<ObstacleSpec> obstacles = new ArrayList<>();

    private RandomWorld(String name, double lengthM, double widthM, long seed) {
        if (!(lengthM >= 2 && lengthM <= 900 && widthM >= 2 && widthM <= 900)) {
            throw new IllegalArgumentException(
                    "a random " + name + " is " + lengthM + " m by " + widthM + " m, expected from 2 m to 900 m");
        }
        this.name = name;
        halfX = lengthM / 2;
        halfY = widthM / 2;
        random = new SplittableRandom(seed);
    }

    /**
     * A square arena with boxes of 0.3 m to 1.2 m.
     *
     * @param boxesPerM2 their number divided by the area
     */
    public static RandomWorld arena(long seed, double sideM, double boxesPerM2) {
        var world = new RandomWorld("arena", sideM, sideM, seed);
        world.surround();
        if (!(boxesPerM2 >= 0 && boxesPerM2 <= 4)) {
            throw new IllegalArgumentException(boxesPerM2 + " boxes a square metre, expected from 0 to 4");
        }
        int boxes = (int) (sideM * sideM * boxesPerM2);
        for (int i = 0; i < boxes; i++) {
            Pose pose = world.somewhere(0.6);
            double lengthM = world.random.nextDouble(0.3, 1.2);
            double widthM = world.random.nextDouble(0.3, 0.6);
            world.add("box" + i, pose, box(lengthM, widthM), BOX);
        }
        return world;
    }

    /**
     * A maze in which exactly one way leads from each cell to each other one. Walls in one line are one wall.
     *
     * @param cellM distance of the walls, from middle to middle
     */
    public static RandomWorld maze(long seed, int columns, int rows, double cellM) {
        var world = new RandomWorld("maze", columns * cellM, rows * cellM, seed);
        world.surround();
        var walls = new MazeWalls(columns, rows, world.random);
        for (int row = 1; row < rows; row++) {
            int at = row;
            world.addRuns(
                    walls.alongX[at],
                    cellM,
                    (from, to) -> world.wall(
                            (from + to) * cellM / 2 - world.halfX,
                            at * cellM - world.halfY,
                            (to - from) * cellM + WALL_M,
                            WALL_M));
        }
        for (int column = 1; column < columns; column++) {
            int at = column;
            world.addRuns(
                    walls.alongY[at],
                    cellM,
                    (from, to) -> world.wall(
                            at * cellM - world.halfX,
                            (from + to) * cellM / 2 - world.halfY,
                            WALL_M,
                            (to - from) * cellM + WALL_M));
        }
        return world;
    }

    /** Rooms of 5 m by 5 m with a door in each inner wall, and a table in most of them. */
    public static RandomWorld office(long seed, int roomsAlongX, int roomsAlongY) {
        double roomM = 5;
        double doorM = 1.2;
        var world = new RandomWorld("office", roomsAlongX * roomM, roomsAlongY * roomM, seed);
        world.surround();
        for (int i = 0; i < roomsAlongX; i++) {
            for (int j = 0; j < roomsAlongY; j++) {
                double west = i * roomM - world.halfX;
                double south = j * roomM - world.halfY;
                double door = world.random.nextDouble(doorM, roomM - doorM);
                double before = door - doorM / 2;
                double after = roomM - door - doorM / 2;
                if (i > 0) {
                    world.wall(west, south + before / 2, WALL_M, before);
                    world.wall(west, south + roomM - after / 2, WALL_M, after);
                }
                if (j > 0) {
                    world.wall(west + before / 2, south, before, WALL_M);
                    world.wall(west + roomM - after / 2, south, after, WALL_M);
                }
                if (world.random.nextInt(4) > 0) {
                    double x = west + world.random.nextDouble(1.6, roomM - 1.6);
                    double y = south + world.random.nextDouble(1.6, roomM - 1.6);
                    var pose = new Pose(x, y, world.random.nextDouble(StrictMath.PI));
                    world.add("table" + i + "-" + j, pose, box(1.4, 0.7), BOX);
                }
            }
        }
        return world;
    }

    /** A square cave of ragged rock on a grid of 0.25 m, in one piece like the walls of a bitmap. */
    public static RandomWorld cave(long seed, double sideM) {
        double pixelM = 0.25;
        var world = new RandomWorld("cave", sideM, sideM, seed);
        int side = (int) Math.ceil(sideM / pixelM);
        Pixels rock = new Pixels(side, side);
        for (int y = 0; y < side; y++) {
            for (int x = 0; x < side; x++) {
                if (world.random.nextInt(100) < 42) {
                    rock.darken(x, y);
                }
            }
        }
        for (int i = 0; i < 4; i++) {
            rock = smoothed(rock);
        }
        List<List<Point>> pieces = rock.rectangles().stream()
                .map(piece -> Polygons.rectangle(piece.minX(), piece.minY(), piece.maxX(), piece.maxY()))
                .toList();
        var shape = new Shape(world.scaled(pieces, pixelM), world.scaled(rock.outlines(), pixelM));
        world.add("rock", Pose.ORIGIN, shape, WALL);
        return world;
    }

    /** Rock where most of nine pixels are rock, and at the rim. */
    private static Pixels smoothed(Pixels rock) {
        var result = new Pixels(rock.width, rock.height);
        for (int y = 0; y < rock.height; y++) {
            for (int x = 0; x < rock.width; x++) {
                int dark = 0;
                for (int dy = -1; dy <= 1; dy++) {
                    for (int dx = -1; dx <= 1; dx++) {
                        dark += rock.isDark(x + dx, y + dy) ? 1 : 0;
                    }
                }
                boolean atRim = x == 0 || y == 0 || x == rock.width - 1 || y == rock.height - 1;
                if (atRim || dark >= 5) {
                    result.darken(x, y);
                }
            }
        }
        return result;
    }

    private List<List<Point>> scaled(List<List<Point>> rings, double pixelM) {
        return rings.stream()
                .map(ring -> ring.stream()
                        .map(point -> new Point(point.x() * pixelM - halfX, point.y() * pixelM - halfY))
                        .toList())
                .toList();
    }

    /** The world with this number of robots, {@code robot1}, {@code robot2}, .., at random free places. */
    public WorldSpec withRobots(int count) {
        return withRobots(count, robot -> robot);
    }

    /** As {@link #withRobots(int)}, each robot changed by the operator. */
    public WorldSpec withRobots(int count, UnaryOperator<RobotSpec> change) {
        var free = new FreePlaces(obstacles);
        List<RobotSpec> robots = new ArrayList<>();
        for (int i = 1; i <= count; i++) {
            robots.add(change.apply(pioneer("robot" + i, free.next(this, i))));
        }
        return new WorldSpec(name, FILE, 100, robots, obstacles);
    }

    private static RobotSpec pioneer(String name, Pose pose) {
        Shape shape = new Shape(List.of(Polygons.rectangle(-0.26, -0.19, 0.18, 0.19)));
        var mounts = IntStream.range(0, PIONEER_SONARS.length)
                .mapToObj(i -> PIONEER_SONARS[i])
                .map(sonar -> new Pose(sonar[0], sonar[1], sonar[2] * DEGREE))
                .toList();
        var sonar = new SonarSpec(mounts, 0, 5, 15 * DEGREE);
        @Nullable BlobfinderSpec none = null;
        return new RobotSpec(
                name,
                pose,
                shape,
                ROBOT,
                0.44,
                0.38,
                23,
                new Pose(-0.04, 0, 0),
                Pose.ORIGIN,
                sonar,
                none,
                List.of(),
                true,
                true,
                new SourcePosition(FILE, 1, 1));
    }

    private void surround() {
        wall(halfX + WALL_M / 2, 0, WALL_M, 2 * (halfY + WALL_M));
        wall(-halfX - WALL_M / 2, 0, WALL_M, 2 * (halfY + WALL_M));
        wall(0, halfY + WALL_M / 2, 2 * halfX, WALL_M);
        wall(0, -halfY - WALL_M / 2, 2 * halfX, WALL_M);
    }

    private void wall(double x, double y, double lengthM, double widthM) {
        add("wall" + obstacles.size(), new Pose(x, y, 0), box(lengthM, widthM), WALL);
    }

    private void add(String obstacle, Pose pose, Shape shape, int colour) {
        obstacles.add(
                new ObstacleSpec(obstacle, pose, shape, colour, true, true, true, new SourcePosition(FILE, 1, 1)));
    }

    private static Shape box(double lengthM, double widthM) {
        return new Shape(List.of(Polygons.rectangle(-lengthM / 2, -widthM / 2, lengthM / 2, widthM / 2)));
    }

    private Pose somewhere(double fromWallM) {
        return new Pose(
                random.nextDouble(-halfX + fromWallM, halfX - fromWallM),
                random.nextDouble(-halfY + fromWallM, halfY - fromWallM),
                random.nextDouble(-StrictMath.PI, StrictMath.PI));
    }

    /** A wall from one line of the grid to another. */
    private interface Run {
        void add(int from, int to);
    }

    private void addRuns(boolean[] walls, double cellM, Run run) {
        int from = -1;
        for (int i = 0; i <= walls.length; i++) {
            boolean wall = i < walls.length && walls[i];
            if (wall && from < 0) {
                from = i;
            } else if (!wall && from >= 0) {
                run.add(from, i);
                from = -1;
            }
        }
    }

    /** The walls of a maze: those of a random tree over its cells are taken away. */
    private static final class MazeWalls {
        final boolean[][] alongX; // by row of the cell above, then by column
        final boolean[][] alongY; // by column of the cell to the right, then by row
        private final int[] group; // of connected cells

        MazeWalls(int columns, int rows, SplittableRandom random) {
            alongX = new boolean[rows][columns];
            alongY = new boolean[columns][rows];
            group = IntStream.range(0, columns * rows).toArray();
            List<int[]> walls = new ArrayList<>(); // 0 or 1, then the two indices
            for (int row = 0; row < rows; row++) {
                for (int column = 0; column < columns; column++) {
                    alongX[row][column] = true;
                    alongY[column][row] = true;
                    if (row > 0) {
                        walls.add(new int[] {0, row, column});
                    }
                    if (column > 0) {
                        walls.add(new int[] {1, column, row});
                    }
                }
            }
            for (int i = walls.size() - 1; i >= 0; i--) {
                int other = random.nextInt(i + 1);
                int[] wall = walls.get(other);
                walls.set(other, walls.get(i));
                int cell = wall[0] == 0 ? wall[1] * columns + wall[2] : wall[2] * columns + wall[1];
                int before = wall[0] == 0 ? cell - columns : cell - 1;
                if (find(cell) != find(before)) {
                    group[find(cell)] = find(before);
                    (wall[0] == 0 ? alongX : alongY)[wall[1]][wall[2]] = false;
                }
            }
        }

        private int find(int cell) {
            int at = cell;
            while (group[at] != at) {
                group[at] = group[group[at]];
                at = group[at];
            }
            return at;
        }
    }

    /** Places with nothing within {@link #FREE_M}, nor a robot within twice that. */
    private static final class FreePlaces {
        private final List<Box> boxes = new ArrayList<>();
        private final List<List<Point>> polygons = new ArrayList<>();
        private final List<Pose> taken = new ArrayList<>();

        FreePlaces(List<ObstacleSpec> obstacles) {
            for (ObstacleSpec obstacle : obstacles) {
                for (List<Point> polygon : obstacle.shape().polygons()) {
                    List<Point> placed =
                            polygon.stream().map(obstacle.pose()::place).toList();
                    polygons.add(placed);
                    var x = placed.stream().mapToDouble(Point::x).summaryStatistics();
                    var y = placed.stream().mapToDouble(Point::y).summaryStatistics();
                    boxes.add(new Box(
                            x.getMin() - FREE_M, y.getMin() - FREE_M, x.getMax() + FREE_M, y.getMax() + FREE_M));
                }
            }
        }

        Pose next(RandomWorld world, int robot) {
            for (int i = 0; i < MOST_TRIES; i++) {
                Pose pose = world.somewhere(FREE_M);
                if (isFree(pose)) {
                    taken.add(pose);
                    return pose;
                }
            }
            throw new IllegalArgumentException("found no free place for robot " + robot + " in this " + world.name
                    + " in " + MOST_TRIES + " tries, expected fewer robots or a larger world");
        }

        private boolean isFree(Pose pose) {
            for (int i = 0; i < polygons.size(); i++) {
                if (boxes.get(i).holds(pose.x(), pose.y()) && isNear(polygons.get(i), pose)) {
                    return false;
                }
            }
            return taken.stream()
                    .noneMatch(other -> StrictMath.hypot(pose.x() - other.x(), pose.y() - other.y()) < 2 * FREE_M);
        }

        /** True unless all of the convex polygon is beyond a line at that distance. */
        private static boolean isNear(List<Point> polygon, Pose pose) {
            Point from = polygon.getLast();
            for (Point to : polygon) {
                double lengthM = Polygons.distance(from, to);
                double leftM = Polygons.turn(from, to, new Point(pose.x(), pose.y())) / lengthM;
                if (leftM < -FREE_M) {
                    return false;
                }
                from = to;
            }
            return true;
        }
    }
}
