package io.troupe.sim.device;

import io.troupe.sim.scenario.CargoSpec;
import io.troupe.sim.scenario.ObstacleSpec;
import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.RobotSpec;
import io.troupe.sim.scenario.WorldSpec;
import java.util.ArrayList;
import java.util.List;

/**
 * Where everything is: what the devices look at.
 *
 * <p><b>Role.</b> Answers rays and distances exactly, in double precision, whatever the physics does.
 * <p><b>Order.</b> {@link #place} every robot that moved, then {@link #refresh}, then read devices.
 * <p><b>Threads.</b> One thread at a time.
 * <p><b>Cost.</b> A ray looks only at what shares a one-metre cell with it, and allocates nothing.
 */
public final class Scene {
    private static final double RIM_M = 1;

    private final List<Outline> walls = new ArrayList<>(); // those that block bodies
    private final Outline[] robots;
    private final Pose[] poses;
    private final List<List<Part>> parts = new ArrayList<>(); // by robot
    private final int[] colours; // by thing: obstacles, then robots, then what they carry
    private final int firstRobot;
    private final Segments moving = new Segments();
    private final CellIndex movingIndex;
    private final RayCaster caster;
    private final Ray ray = new Ray();

    /** What rays see of a robot: its body, or a thing it carries. */
    private record Part(Outline outline, int thing, int rayKinds) {}

    /** The world with every robot at its start pose. */
    public Scene(WorldSpec spec) {
        List<ObstacleSpec> obstacles = spec.obstacles();
        firstRobot = obstacles.size();
        int robotCount = spec.robots().size();
        robots = new Outline[robotCount];
        poses = new Pose[robotCount];
        int cargoCount =
                spec.robots().stream().mapToInt(robot -> robot.cargo().size()).sum();
        colours = new int[firstRobot + robotCount + cargoCount];
        var fixed = new Segments();
        for (int i = 0; i < firstRobot; i++) {
            ObstacleSpec obstacle = obstacles.get(i);
            var outline = new Outline(obstacle.shape(), obstacle.pose());
            fixed.add(outline, i, rayKinds(obstacle.blocksRangers(), obstacle.visible()));
            colours[i] = obstacle.colour();
            if (obstacle.blocksBodies()) {
                walls.add(outline);
            }
        }
        int cargo = firstRobot + robotCount;
        for (int i = 0; i < robotCount; i++) {
            addRobot(i, spec.robots().get(i), cargo);
            cargo += spec.robots().get(i).cargo().size();
        }
        showRobots();
        Grid grid = gridAround(fixed, moving);
        var fixedIndex = new CellIndex(grid, fixed);
        fixedIndex.rebuild();
        movingIndex = new CellIndex(grid, moving);
        caster = new RayCaster(grid, fixedIndex, movingIndex);
        refresh();
    }

    private void addRobot(int index, RobotSpec robot, int firstCargo) {
        robots[index] = new Outline(robot.collisionShape(), robot.pose());
        poses[index] = robot.pose();
        Outline body = robot.cargo().isEmpty() ? robots[index] : new Outline(robot.shape(), robot.pose());
        var seen = new ArrayList<Part>();
        seen.add(new Part(body, firstRobot + index, rayKinds(robot.blocksRangers(), robot.visible())));
        colours[firstRobot + index] = robot.colour();
        int thing = firstCargo;
        for (CargoSpec piece : robot.cargo()) {
            var outline = new Outline(piece.shape(), robot.pose());
            seen.add(new Part(outline, thing, rayKinds(piece.blocksRangers(), piece.visible())));
            colours[thing++] = piece.colour();
        }
        parts.add(seen);
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
                minX = Math.min(minX, segments.x[s]);
                minY = Math.min(minY, segments.y[s]);
                maxX = Math.max(maxX, segments.x[s]);
                maxY = Math.max(maxY, segments.y[s]);
            }
        }
        return new Grid(minX - RIM_M, minY - RIM_M, maxX + RIM_M, maxY + RIM_M);
    }

    /** Moves a robot; rays notice after {@link #refresh}. */
    public void place(int robot, Pose pose) {
        poses[robot] = pose;
        robots[robot].place(pose);
        List<Part> seen = parts.get(robot);
        for (int i = 0; i < seen.size(); i++) {
            Outline outline = seen.get(i).outline;
            if (outline != robots[robot]) {
                outline.place(pose);
            }
        }
    }

    /** Lets rays see the robots where they are now. */
    public void refresh() {
        showRobots();
        movingIndex.rebuild();
    }

    private void showRobots() {
        moving.clear();
        for (int i = 0; i < robots.length; i++) {
            List<Part> seen = parts.get(i);
            for (int j = 0; j < seen.size(); j++) {
                Part part = seen.get(j);
                moving.add(part.outline, part.thing, firstRobot + i, part.rayKinds);
            }
        }
    }

    /** From the robot's edge to the nearest obstacle that blocks bodies: 0 if they touch or overlap, infinite if there is none. */
    public double wallGapM(int robot) {
        double gap = Double.POSITIVE_INFINITY;
        for (int i = 0; i < walls.size(); i++) {
            gap = robots[robot].gapM(walls.get(i), gap);
        }
        return gap;
    }

    /**
     * Casts a fan of rays from a robot, which they ignore.
     *
     * @param kind {@link Ray#RANGE} or {@link Ray#SIGHT}
     * @param things receives what each ray hit, or {@link Ray#NOTHING}
     * @param distancesM receives how far away that is, or infinity
     */
    void cast(int robot, RayFan fan, int kind, double maxM, int[] things, double[] distancesM) {
        Pose pose = poses[robot];
        double cos = StrictMath.cos(pose.headingRad());
        double sin = StrictMath.sin(pose.headingRad());
        ray.skip = firstRobot + robot;
        ray.kind = kind;
        ray.maxM = maxM;
        for (int i = 0; i < fan.size(); i++) {
            ray.x = pose.x() + cos * fan.x[i] - sin * fan.y[i];
            ray.y = pose.y() + sin * fan.x[i] + cos * fan.y[i];
            ray.dirX = cos * fan.dirX[i] - sin * fan.dirY[i];
            ray.dirY = sin * fan.dirX[i] + cos * fan.dirY[i];
            caster.cast(ray);
            things[i] = ray.hitThing;
            distancesM[i] = ray.hitM;
        }
    }

    int colour(int thing) {
        return colours[thing];
    }
}
