package io.troupe.sim.device;

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
    private final int[] robotRayKinds;
    private final int[] colours; // by thing: obstacles, then robots
    private final int firstRobot;
    private final Segments moving = new Segments();
    private final CellIndex movingIndex;
    private final RayCaster caster;
    private final Ray ray = new Ray();

    /** The world with every robot at its start pose. */
    public Scene(WorldSpec spec) {
        List<ObstacleSpec> obstacles = spec.obstacles();
        firstRobot = obstacles.size();
        int robotCount = spec.robots().size();
        robots = new Outline[robotCount];
        poses = new Pose[robotCount];
        robotRayKinds = new int[robotCount];
        colours = new int[firstRobot + robotCount];
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
        for (int i = 0; i < robotCount; i++) {
            RobotSpec robot = spec.robots().get(i);
            robots[i] = new Outline(robot.shape(), robot.pose());
            poses[i] = robot.pose();
            robotRayKinds[i] = rayKinds(robot.blocksRangers(), robot.visible());
            colours[firstRobot + i] = robot.colour();
            moving.add(robots[i], firstRobot + i, robotRayKinds[i]);
        }
        Grid grid = gridAround(fixed, moving);
        var fixedIndex = new CellIndex(grid, fixed);
        fixedIndex.rebuild();
        movingIndex = new CellIndex(grid, moving);
        caster = new RayCaster(grid, fixedIndex, movingIndex);
        refresh();
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
    }

    /** Lets rays see the robots where they are now. */
    public void refresh() {
        moving.clear();
        for (int i = 0; i < robots.length; i++) {
            moving.add(robots[i], firstRobot + i, robotRayKinds[i]);
        }
        movingIndex.rebuild();
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
