package io.troupe.sim.device;

import static java.util.Objects.requireNonNull;

import io.troupe.sim.model.CargoSpec;
import io.troupe.sim.model.DeviceSpec;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.numeric.Direction;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.DoubleStream;
import org.jspecify.annotations.Nullable;

/**
 * The geometry that the devices sense: all outlines and colours.
 *
 * <p><b>Role.</b> Computes rays and distances exactly, in double precision, independent of the physics.
 *
 * <p><b>Order.</b> {@link #place} every robot that moved, then {@link #refresh}, then read devices.
 *
 * <p><b>Threads.</b> One thread at a time moves robots. While none moves robots, several threads may read devices, each
 * with its own {@link Scratch}.
 *
 * <p><b>Cost.</b> A ray tests only the segments in the one-metre cells that it crosses, and allocates nothing.
 *
 * <p>Long, because it holds what stands still, what moves and what is carried, for all kinds of devices alike.
 */
public final class Scene {
    private static final double RIM_M = 1;
    private static final int NOBODY = -1;
    /** With more things near the robot, the rays walk through the grid. */
    private static final int MOST_THINGS_PER_RAY = 8;

    private final NearestWalls walls;
    private final int robotCount;
    private final Outline[] robots; // and after them the obstacles that move, as in the next fields
    private final double[] x; // of the robots
    private final double[] y;
    private final double[] cos;
    private final double[] sin;
    private final double[] headingRad;
    private final boolean[] blocksBodies;
    private final int[] movers; // indices of the obstacles that move
    private final int[] carrierOf; // by mover, the robot whose gripper holds it
    private final boolean[] absent; // by mover
    private final @Nullable Markers markers; // null if there is no finder
    private final List<List<Part>> parts = new ArrayList<>(); // by robot
    private final int[] colours; // by thing: obstacles, then robots, then what they carry
    private final int firstRobot;
    private final Segments moving = new Segments();
    private final CellIndex movingIndex;
    private final RayCaster caster;
    private final FanProjection fixedProjection;
    private final FanProjection movingProjection;
    private final double[] movingX; // of the parts of robots, in order
    private final double[] movingY;
    private final Direction direction = new Direction();
    private final BoundingCircles circles;
    private final WorldSpec spec;
    private double @Nullable [] reflectances; // by thing; null until a ranger measures intensities
    private final List<ColourGroup> fixedGroups = new ArrayList<>();
    private final List<ColourGroup> movingGroups = new ArrayList<>();

    /** A visible part of a robot: its body, or a thing it carries. */
    private record Part(Outline outline, int thing, int rayKinds, int index) {}

    /** Creates the scene with every robot at its start pose. */
    public Scene(WorldSpec spec) {
        this.spec = spec;
        List<ObstacleSpec> obstacles = spec.obstacles();
        firstRobot = obstacles.size();
        robotCount = spec.robots().size();
        movers = spec.movingObstacles().stream().mapToInt(Integer::intValue).toArray();
        int bodyCount = robotCount + movers.length;
        robots = new Outline[bodyCount];
        x = new double[bodyCount];
        y = new double[bodyCount];
        cos = new double[bodyCount];
        sin = new double[bodyCount];
        headingRad = new double[bodyCount];
        blocksBodies = new boolean[bodyCount];
        carrierOf = new int[movers.length];
        Arrays.fill(carrierOf, NOBODY);
        absent = new boolean[movers.length];
        markers = hasFinder(spec) ? new Markers(spec) : null;
        int cargoCount =
                spec.robots().stream().mapToInt(robot -> robot.cargo().size()).sum();
        circles = new BoundingCircles(firstRobot + robotCount + cargoCount);
        Map<Integer, List<Integer>> fixedByColour = new LinkedHashMap<>();
        Map<Integer, List<Integer>> movingByColour = new LinkedHashMap<>();
        colours = new int[firstRobot + robotCount + cargoCount];
        var fixed = new Fixed();
        for (int i = 0; i < firstRobot; i++) {
            ObstacleSpec obstacle = obstacles.get(i);
            boolean moves = Arrays.binarySearch(movers, i) >= 0;
            paint(i, obstacle.colour(), obstacle.visible(), moves ? movingByColour : fixedByColour);
            if (!moves) {
                addFixed(i, obstacle, fixed);
            }
        }
        walls = new NearestWalls(fixed.blocking);
        movingX = new double[robotCount + cargoCount + movers.length];
        movingY = new double[robotCount + cargoCount + movers.length];
        int cargo = firstRobot + robotCount;
        for (int i = 0; i < robotCount; i++) {
            addRobot(i, spec.robots().get(i), cargo, movingByColour);
            cargo += spec.robots().get(i).cargo().size();
        }
        for (int i = 0; i < movers.length; i++) {
            addMover(i, obstacles.get(movers[i]), robotCount + cargoCount + i);
        }
        showRobots();
        Grid grid = gridAround(fixed.segments, moving);
        var fixedIndex = new CellIndex(grid, fixed.segments);
        fixedIndex.rebuild();
        movingIndex = new CellIndex(grid, moving);
        caster = new RayCaster(grid, fixedIndex, movingIndex);
        fixedProjection = new FanProjection(grid, fixed.segments, fixed.outlines, false);
        fixedProjection.sort(fixed.x, fixed.y);
        movingProjection = new FanProjection(grid, moving, movingOutlines(), true);
        fixedByColour.forEach((colour, things) -> fixedGroups.add(new ColourGroup(colour, things, circles)));
        movingByColour.forEach((colour, things) -> movingGroups.add(new ColourGroup(colour, things, circles)));
        refresh();
    }

    /** What stands still, while the scene is created. */
    private static final class Fixed {
        final Segments segments = new Segments();
        final FanProjection.Outlines outlines = new FanProjection.Outlines();
        final List<Double> x = new ArrayList<>();
        final List<Double> y = new ArrayList<>();
        final List<Outline> blocking = new ArrayList<>();
    }

    private void addFixed(int thing, ObstacleSpec obstacle, Fixed fixed) {
        var outline = new Outline(obstacle.shape(), obstacle.pose());
        int kinds = rayKinds(obstacle.blocksRangers(), obstacle.visible());
        addRings(outline, thing, kinds, fixed.segments.count, fixed.outlines, fixed.x, fixed.y);
        fixed.segments.add(outline, thing, kinds);
        circles.set(thing, outline.centreX(), outline.centreY(), outline);
        if (obstacle.blocksBodies()) {
            fixed.blocking.add(outline);
        }
    }

    private static boolean hasFinder(WorldSpec spec) {
        return spec.robots().stream()
                .anyMatch(robot -> robot.devices().stream().anyMatch(DeviceSpec.FiducialFinder.class::isInstance));
    }

    private void paint(int thing, int colour, boolean visible, Map<Integer, List<Integer>> byColour) {
        colours[thing] = colour;
        if (visible) {
            byColour.computeIfAbsent(colour, each -> new ArrayList<>()).add(thing);
        }
    }

    private void addRobot(int index, RobotSpec robot, int firstCargo, Map<Integer, List<Integer>> byColour) {
        Pose pose = robot.pose();
        blocksBodies[index] = robot.blocksBodies();
        robots[index] = new Outline(robot.collisionShape(), pose);
        Outline body = robot.cargo().isEmpty() ? robots[index] : new Outline(robot.shape(), pose);
        var seen = new ArrayList<Part>();
        seen.add(new Part(
                body,
                firstRobot + index,
                rayKinds(robot.blocksRangers(), robot.visible()),
                index + firstCargo - firstRobot - robotCount));
        circles.set(firstRobot + index, pose.x(), pose.y(), body);
        paint(firstRobot + index, robot.colour(), robot.visible(), byColour);
        int thing = firstCargo;
        for (CargoSpec piece : robot.cargo()) {
            var outline = new Outline(piece.shape(), pose);
            seen.add(new Part(
                    outline,
                    thing,
                    rayKinds(piece.blocksRangers(), piece.visible()),
                    index + 1 + thing - firstRobot - robotCount));
            circles.set(thing, pose.x(), pose.y(), outline);
            paint(thing++, piece.colour(), piece.visible(), byColour);
        }
        parts.add(seen);
        place(index, pose);
    }

    private void addMover(int number, ObstacleSpec obstacle, int partIndex) {
        int body = robotCount + number;
        blocksBodies[body] = obstacle.blocksBodies();
        robots[body] = new Outline(obstacle.shape(), obstacle.pose());
        int kinds = rayKinds(obstacle.blocksRangers(), obstacle.visible())
                | (obstacle.traits().grippable() ? Ray.GRIP : 0);
        parts.add(List.of(new Part(robots[body], movers[number], kinds, partIndex)));
        circles.set(movers[number], obstacle.pose().x(), obstacle.pose().y(), robots[body]);
        place(body, obstacle.pose());
    }

    /** Number of the thing that a body is, or of the robot that holds it: the rays of that robot ignore it. */
    private int carrierNumber(int body) {
        if (body < robotCount) {
            return firstRobot + body;
        }
        int holder = carrierOf[body - robotCount];
        return holder == NOBODY ? movers[body - robotCount] : firstRobot + holder;
    }

    /** Sets which robot's gripper holds a thing that moves; -1 = none. */
    public void carry(int mover, int robot) {
        carrierOf[mover] = robot;
        int body = robotCount + mover;
        movingProjection.setCarrier(parts.get(body).getFirst().index, carrierNumber(body));
    }

    /** Sets whether a thing that moves is in the world; if not, nothing senses it. */
    public void show(int mover, boolean present) {
        absent[mover] = !present;
        int body = robotCount + mover;
        blocksBodies[body] = present && spec.obstacles().get(movers[mover]).blocksBodies();
        Part part = parts.get(body).getFirst();
        movingProjection.setKinds(part.index, rayKinds(body, part));
    }

    /** False for a thing that moves and has been taken out of the world. */
    boolean isThere(int body) {
        return body < robotCount || !absent[body - robotCount];
    }

    private int rayKinds(int body, Part part) {
        return isThere(body) ? part.rayKinds : 0;
    }

    /** Which of the things that move is the obstacle with an index; -1 if it stands still. */
    int mover(int thing) {
        int number = Arrays.binarySearch(movers, thing);
        return number < 0 ? NOBODY : number;
    }

    private static int rayKinds(boolean blocksRangers, boolean visible) {
        return (blocksRangers ? Ray.RANGE : 0) | (visible ? Ray.SIGHT : 0);
    }

    private static Grid gridAround(Segments... all) {
        double minX = 0;
        double minY = 0;
        double maxX = 0;
        double maxY = 0;
        for (Segments segments : all) {
            for (int s = 0; s < segments.count; s++) {
                minX = Math.min(minX, segments.x(s));
                minY = Math.min(minY, segments.y(s));
                maxX = Math.max(maxX, segments.x(s));
                maxY = Math.max(maxY, segments.y(s));
            }
        }
        return new Grid(minX - RIM_M, minY - RIM_M, maxX + RIM_M, maxY + RIM_M);
    }

    /** Moves a robot; rays see it there after {@link #refresh}. */
    public void place(int robot, Pose pose) {
        place(robot, pose.x(), pose.y(), pose.headingRad());
    }

    /** As {@link #place(int, Pose)}, without allocating a pose. */
    public void place(int robot, double robotX, double robotY, double robotHeadingRad) {
        x[robot] = robotX;
        y[robot] = robotY;
        headingRad[robot] = robotHeadingRad;
        direction.set(robotHeadingRad);
        cos[robot] = direction.cos();
        sin[robot] = direction.sin();
        robots[robot].place(robotX, robotY, cos[robot], sin[robot]);
        List<Part> seen = parts.get(robot);
        for (int i = 0; i < seen.size(); i++) {
            Part part = seen.get(i);
            if (part.outline != robots[robot]) {
                part.outline.place(robotX, robotY, cos[robot], sin[robot]);
            }
            circles.x[part.thing] = robotX;
            circles.y[part.thing] = robotY;
            movingX[part.index] = robotX;
            movingY[part.index] = robotY;
        }
    }

    /** Updates the ray caster with the robots' current poses. */
    public void refresh() {
        showRobots();
        movingIndex.rebuild();
        movingProjection.sort(movingX, movingY);
        for (int i = 0; i < movingGroups.size(); i++) {
            movingGroups.get(i).sort();
        }
        if (markers != null) {
            markers.refresh(this);
        }
    }

    private void showRobots() {
        moving.clear();
        for (int i = 0; i < robots.length; i++) {
            List<Part> seen = parts.get(i);
            for (int j = 0; j < seen.size(); j++) {
                Part part = seen.get(j);
                moving.add(part.outline, part.thing, carrierNumber(i), rayKinds(i, part));
            }
        }
    }

    /** Adds the lines of an obstacle, whose edges begin at the given one. */
    private static void addRings(
            Outline outline,
            int thing,
            int rayKinds,
            int firstSegment,
            FanProjection.Outlines outlines,
            List<Double> centresX,
            List<Double> centresY) {
        int first = firstSegment;
        for (Ring ring : outline.rings()) {
            double x = (ring.minX + ring.maxX) / 2;
            double y = (ring.minY + ring.maxY) / 2;
            outlines.add(thing, rayKinds, first, first + ring.x.length, ring.radiusM(x, y));
            centresX.add(x);
            centresY.add(y);
            first += ring.x.length;
        }
    }

    /** The parts of all robots, in the order of their edges. */
    private FanProjection.Outlines movingOutlines() {
        var outlines = new FanProjection.Outlines();
        int first = 0;
        for (int i = 0; i < robots.length; i++) {
            for (Part part : parts.get(i)) {
                int end = first;
                double radiusM = 0;
                for (Ring ring : part.outline.rings()) {
                    end += ring.x.length;
                    radiusM = Math.max(radiusM, ring.radiusM(x[i], y[i]));
                }
                outlines.add(carrierNumber(i), part.rayKinds, first, end, radiusM);
                first = end;
            }
        }
        return outlines;
    }

    /**
     * Distance from the robot's edge to the nearest obstacle that blocks bodies: 0 if they touch or overlap, infinite
     * if there is none.
     */
    public double wallGapM(int robot) {
        double gapM = walls.gapM(robots[robot]);
        for (int i = 0; i < movers.length; i++) {
            if (carrierOf[i] == NOBODY && blocksBodies[robotCount + i]) {
                gapM = robots[robotCount + i].gapM(robots[robot], gapM);
            }
        }
        return gapM;
    }

    /** True if an obstacle or another robot that blocks bodies touches or overlaps a zone of this robot. */
    boolean hasBodyIn(int robot, Outline zone) {
        if (walls.gapM(zone) == 0) {
            return true;
        }
        for (int other = 0; other < robots.length; other++) {
            if (other != robot
                    && blocksBodies[other]
                    && carrierNumber(other) != firstRobot + robot
                    && robots[other].isWithin(zone, 0)) {
                return true;
            }
        }
        return false;
    }

    /** The markers, or null if no robot has a finder. */
    @Nullable
    Markers markers() {
        return markers;
    }

    double x(int robot) {
        return x[robot];
    }

    double y(int robot) {
        return y[robot];
    }

    double headingRad(int robot) {
        return headingRad[robot];
    }

    double cos(int robot) {
        return cos[robot];
    }

    double sin(int robot) {
        return sin[robot];
    }

    /**
     * True if nothing that rangers or blobfinders notice is between a point of a robot and a point of a thing, other
     * than this robot and that thing. A robot does not see itself.
     *
     * @param dx from the first point to the second, as is {@code dy}
     */
    boolean isInSight(int robot, double fromX, double fromY, double dx, double dy, int thing, Ray ray) {
        double distanceM = StrictMath.hypot(dx, dy);
        if (thing == firstRobot + robot || distanceM == 0) {
            return thing != firstRobot + robot;
        }
        ray.x = fromX;
        ray.y = fromY;
        ray.dirX = dx / distanceM;
        ray.dirY = dy / distanceM;
        ray.skip = firstRobot + robot;
        ray.kind = Ray.RANGE | Ray.SIGHT;
        ray.maxM = distanceM;
        caster.cast(ray);
        return ray.hitThing == Ray.NOTHING || ray.hitM >= distanceM || carrier(ray.hitThing) == thing;
    }

    /**
     * Number of the first grippable thing on a ray from a point of a robot, of those that move; -1 if there is none.
     */
    int gripped(int robot, double localX, double localY, double localHeadingRad, double rangeM, Ray ray) {
        direction.set(headingRad[robot] + localHeadingRad);
        ray.x = x[robot] + cos[robot] * localX - sin[robot] * localY;
        ray.y = y[robot] + sin[robot] * localX + cos[robot] * localY;
        ray.dirX = direction.cos();
        ray.dirY = direction.sin();
        ray.skip = Ray.NOTHING;
        ray.kind = Ray.GRIP;
        ray.maxM = rangeM;
        caster.cast(ray);
        return ray.hitThing == Ray.NOTHING ? NOBODY : mover(ray.hitThing);
    }

    /** Extent of a thing that moves along its y axis. */
    double widthM(int mover) {
        var y = spec.obstacles().get(movers[mover]).shape().polygons().stream()
                .flatMap(List::stream)
                .mapToDouble(Point::y)
                .summaryStatistics();
        return y.getMax() - y.getMin();
    }

    /** The robot that carries a thing, or the thing itself. */
    private int carrier(int thing) {
        if (thing < firstRobot + robotCount) {
            return thing;
        }
        int robot = 0; // it is cargo
        while (parts.get(robot).getLast().thing < thing) { // cargo is numbered in the order of the robots
            robot++;
        }
        return firstRobot + robot;
    }

    /**
     * Casts a fan of rays from a robot, which the rays ignore; fills the scratch's things and distances.
     *
     * @param kind {@link Ray#RANGE} or {@link Ray#SIGHT}
     */
    void cast(int robot, RayFan fan, int kind, double maxM, Scratch scratch) {
        prepare(robot, kind, maxM, scratch);
        for (int i = 0; i < fan.size(); i++) {
            cast(robot, fan, i, scratch);
        }
    }

    /**
     * Casts a fan of range rays from a robot, which the rays ignore; fills the distances of the scratch's rays, which
     * are infinite where a ray hits nothing in range. What is hit is not recorded.
     */
    void castRanges(int robot, RayFan fan, double maxM, Scratch scratch) {
        place(robot, fan, scratch.rays);
        walk(robot, fan.size(), maxM, scratch);
    }

    /** As {@link #castRanges}, by projection where that is faster: the same distances, bit for bit. */
    void projectRanges(int robot, List<FanTable> tables, double maxM, Scratch scratch) {
        FanProjection.Rays rays = scratch.rays;
        RayFan fan = tables.getFirst().fan;
        place(robot, fan, rays);
        int near = fixedProjection.countNear(x[robot], y[robot], maxM)
                + movingProjection.countNear(x[robot], y[robot], maxM);
        if (near > MOST_THINGS_PER_RAY * fan.size()) {
            walk(robot, fan.size(), maxM, scratch);
            return;
        }
        project(fixedProjection, robot, tables, maxM, rays);
        project(movingProjection, robot, tables, maxM, rays);
    }

    private void place(int robot, RayFan fan, FanProjection.Rays rays) {
        double robotCos = cos[robot];
        double robotSin = sin[robot];
        for (int i = 0; i < fan.size(); i++) {
            rays.x[i] = x[robot] + robotCos * fan.x[i] - robotSin * fan.y[i];
            rays.y[i] = y[robot] + robotSin * fan.x[i] + robotCos * fan.y[i];
            rays.dirX[i] = robotCos * fan.dirX[i] - robotSin * fan.dirY[i];
            rays.dirY[i] = robotSin * fan.dirX[i] + robotCos * fan.dirY[i];
            rays.distanceM[i] = Double.POSITIVE_INFINITY;
        }
    }

    private void walk(int robot, int rayCount, double maxM, Scratch scratch) {
        FanProjection.Rays rays = scratch.rays;
        prepare(robot, Ray.RANGE, maxM, scratch);
        Ray ray = scratch.ray;
        for (int i = 0; i < rayCount; i++) {
            ray.x = rays.x[i];
            ray.y = rays.y[i];
            ray.dirX = rays.dirX[i];
            ray.dirY = rays.dirY[i];
            caster.cast(ray);
            rays.distanceM[i] = ray.hitM;
        }
    }

    private void project(
            FanProjection projection, int robot, List<FanTable> tables, double maxM, FanProjection.Rays rays) {
        projection.cast(x[robot], y[robot], cos[robot], sin[robot], tables, firstRobot + robot, Ray.RANGE, maxM, rays);
    }

    /**
     * As {@link #cast}, for only those rays of a camera that may meet a visible thing of one of the given colours; the
     * other rays hit nothing.
     *
     * @return false if there is no such ray, and nothing was cast
     */
    boolean seek(int robot, RayFan fan, boolean atMostHalfTurn, int[] sought, double maxM, Scratch scratch) {
        boolean[] wanted = scratch.wanted();
        Camera camera = scratch.camera;
        camera.place(firstRobot + robot, x[robot], y[robot], cos[robot], sin[robot]);
        camera.look(fan, atMostHalfTurn, maxM);
        camera.found = false;
        mark(fixedGroups, sought, camera, wanted);
        mark(movingGroups, sought, camera, wanted);
        if (!camera.found) {
            return false;
        }
        prepare(robot, Ray.SIGHT, maxM, scratch);
        for (int i = 0; i < fan.size(); i++) {
            if (wanted[i]) {
                wanted[i] = false;
                cast(robot, fan, i, scratch);
            } else {
                scratch.things()[i] = Ray.NOTHING;
                scratch.distancesM()[i] = Double.POSITIVE_INFINITY;
            }
        }
        return true;
    }

    private static void mark(List<ColourGroup> groups, int[] sought, Camera camera, boolean[] wanted) {
        for (int i = 0; i < groups.size(); i++) {
            if (Arrays.binarySearch(sought, groups.get(i).colour) >= 0) {
                groups.get(i).mark(camera, wanted);
            }
        }
    }

    private void prepare(int robot, int kind, double maxM, Scratch scratch) {
        scratch.ray.skip = firstRobot + robot;
        scratch.ray.kind = kind;
        scratch.ray.maxM = maxM;
    }

    private void cast(int robot, RayFan fan, int i, Scratch scratch) {
        Ray ray = scratch.ray;
        double robotCos = cos[robot];
        double robotSin = sin[robot];
        ray.x = x[robot] + robotCos * fan.x[i] - robotSin * fan.y[i];
        ray.y = y[robot] + robotSin * fan.x[i] + robotCos * fan.y[i];
        ray.dirX = robotCos * fan.dirX[i] - robotSin * fan.dirY[i];
        ray.dirY = robotSin * fan.dirX[i] + robotCos * fan.dirY[i];
        caster.cast(ray);
        scratch.things()[i] = ray.hitThing;
        scratch.distancesM()[i] = ray.hitM;
    }

    /** True if intensities can be measured. */
    public boolean hasReflectances() {
        return reflectances != null;
    }

    /** Prepares {@link #reflectance}; called by the thread that moves robots, before rangers measure intensities. */
    public void readReflectances() {
        if (reflectances == null) {
            reflectances = DoubleStream.concat(
                            DoubleStream.concat(
                                    spec.obstacles().stream()
                                            .mapToDouble(each -> each.traits().reflectance()),
                                    spec.robots().stream()
                                            .mapToDouble(each -> each.traits().reflectance())),
                            spec.robots().stream()
                                    .flatMap(robot -> robot.cargo().stream())
                                    .mapToDouble(CargoSpec::reflectance))
                    .toArray();
        }
    }

    double reflectance(int thing) {
        return requireNonNull(reflectances, "read before use")[thing];
    }

    int colour(int thing) {
        return colours[thing];
    }

    /**
     * The visible things of one colour, each with a bounding circle, sorted by x so that those near a camera are found
     * quickly.
     */
    private static final class ColourGroup {
        /** Added to the radius of every circle; far larger than rounding errors. */
        private static final double MARGIN_M = 1e-6;

        final int colour;
        private final BoundingCircles circles;
        private final int[] things;
        private final double[] x; // sorted
        private final double greatestRadiusM;

        ColourGroup(int colour, List<Integer> members, BoundingCircles circles) {
            this.colour = colour;
            this.circles = circles;
            things = members.stream()
                    .sorted(Comparator.comparingDouble(thing -> circles.x[thing]))
                    .mapToInt(Integer::intValue)
                    .toArray();
            x = Arrays.stream(things).mapToDouble(thing -> circles.x[thing]).toArray();
            greatestRadiusM = Arrays.stream(things)
                            .mapToDouble(thing -> circles.radiusM[thing])
                            .max()
                            .orElse(0)
                    + MARGIN_M;
        }

        /** Sorts again after things have moved, by insertion: few change places from one time to the next. */
        void sort() {
            for (int i = 0; i < things.length; i++) {
                int thing = things[i];
                double thingX = circles.x[thing];
                int to = i;
                while (to > 0 && x[to - 1] > thingX) {
                    x[to] = x[to - 1];
                    things[to] = things[to - 1];
                    to--;
                }
                x[to] = thingX;
                things[to] = thing;
            }
        }

        /**
         * Marks the rays of a camera that may meet one of the things within range. It may mark too many rays, never too
         * few.
         */
        void mark(Camera camera, boolean[] wanted) {
            double reachM = camera.rangeM + greatestRadiusM;
            double lastX = camera.x + reachM;
            for (int i = firstFrom(camera.x - reachM); i < x.length && x[i] <= lastX; i++) {
                int thing = things[i];
                if (thing != camera.carrier) {
                    camera.mark(
                            x[i] - camera.x, circles.y[thing] - camera.y, circles.radiusM[thing] + MARGIN_M, wanted);
                }
            }
        }

        private int firstFrom(double leastX) {
            int low = 0;
            int high = x.length;
            while (low < high) {
                int middle = (low + high) >>> 1;
                if (x[middle] < leastX) {
                    low = middle + 1;
                } else {
                    high = middle;
                }
            }
            return low;
        }
    }
}
