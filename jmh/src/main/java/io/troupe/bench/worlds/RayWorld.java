package io.troupe.bench.worlds;

import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.model.WorldSpec;
import java.util.Arrays;
import java.util.List;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * A physics engine with robots on top, as a user of the engine without a simulator would write it.
 *
 * <p>This class allocates nothing for a step or a ray, and computes sines once for each robot and interval; the
 * engine's own allocations are its cost. A camera casts a ray for every column or, in the sparse variant, only for
 * those in which a coloured object can be, as our simulator does.
 */
abstract class RayWorld implements BenchWorld {
    static final int VELOCITY_ITERATIONS = 8;
    static final int POSITION_ITERATIONS = 3;
    static final double FRICTION = 0.3;
    static final int NO_COLOUR = -1;

    private final int robotCount;
    private final boolean driving;
    private final Readings readings;
    private final Wander wander;
    private final Fan rays;
    private final double rangeM;
    private final @Nullable Fan columns; // null: no camera
    private final @Nullable ColouredColumns coloured; // null: every column is cast

    /** Rays in a robot's frame. */
    private record Fan(double[] x, double[] y, double[] dirX, double[] dirY) {
        static Fan of(List<Pose> rays) {
            return new Fan(
                    rays.stream().mapToDouble(Pose::x).toArray(),
                    rays.stream().mapToDouble(Pose::y).toArray(),
                    rays.stream().mapToDouble(ray -> Math.cos(ray.headingRad())).toArray(),
                    rays.stream().mapToDouble(ray -> Math.sin(ray.headingRad())).toArray());
        }
    }

    RayWorld(WorldSpec spec, boolean driving, boolean sparse) {
        this.driving = driving;
        robotCount = spec.robots().size();
        wander = new Wander(robotCount);
        RobotSpec first = spec.robots().getFirst();
        SonarSpec sonar = first.sonar();
        BlobfinderSpec camera = first.blobfinder();
        List<Pose> mounts = sonar != null ? sonar.mounts() : laserRays(first);
        rays = Fan.of(mounts);
        rangeM = sonar != null
                ? sonar.maxRangeM()
                : first.rangers().getFirst().sensors().getFirst().maxRangeM();
        readings = new Readings(robotCount, mounts.size());
        coloured = sparse && camera != null ? new ColouredColumns(spec, camera) : null;
        columns = camera == null ? null : columns(camera);
    }

    /** From right to left. */
    private static List<Pose> laserRays(RobotSpec robot) {
        RangeSensorSpec laser = robot.rangers().getFirst().sensors().getFirst();
        return IntStream.range(0, laser.samples())
                .mapToObj(i -> -laser.fovRad() / 2 + i * laser.fovRad() / (laser.samples() - 1))
                .map(left -> laser.mount().compose(new Pose(0, 0, left)))
                .toList();
    }

    private static Fan columns(BlobfinderSpec camera) {
        return Fan.of(IntStream.range(0, camera.widthPx())
                .mapToObj(i -> camera.fovRad() / 2 - (i + 0.5) * camera.fovRad() / camera.widthPx())
                .map(left -> camera.mount().compose(new Pose(0, 0, left)))
                .toList());
    }

    abstract double x(int robot);

    abstract double y(int robot);

    abstract double headingRad(int robot);

    /** Sets a body's velocity for the next step. */
    abstract void drive(int robot, double forwardMps, double turnRadps);

    abstract void step();

    /** The distance of the nearest object other than this robot; {@code maxM} if there is none. */
    abstract double cast(int robot, double x, double y, double dirX, double dirY, double maxM);

    /** The colour of what the last ray hit, or {@link #NO_COLOUR}. */
    abstract int hitColour();

    @Override
    public final void advance(int intervals) {
        for (int i = 0; i < intervals; i++) {
            advance();
        }
    }

    private void advance() {
        if (driving) {
            for (int i = 0; i < robotCount; i++) {
                wander.decide(i, readings);
            }
        }
        for (int step = 0; step < TiledScene.STEPS_PER_INTERVAL; step++) {
            for (int i = 0; i < robotCount; i++) {
                drive(i, wander.forwardMps[i], wander.turnRadps[i]);
            }
            step();
        }
        sense();
    }

    final void sense() {
        for (int i = 0; i < robotCount; i++) {
            double x = x(i);
            double y = y(i);
            double cos = Math.cos(headingRad(i));
            double sin = Math.sin(headingRad(i));
            for (int k = 0; k < readings.rays; k++) {
                readings.setRangeM(i, k, cast(i, x, y, cos, sin, rays, k, rangeM));
            }
            if (columns != null) {
                look(i, x, y, cos, sin, columns);
            }
        }
    }

    private void look(int robot, double x, double y, double cos, double sin, Fan image) {
        readings.clearRuns(robot);
        int runColour = NO_COLOUR;
        int runFirst = 0;
        if (coloured != null) {
            coloured.seek(x, y, cos, sin);
        }
        for (int k = 0; k < TiledScene.COLUMNS; k++) {
            int colour = NO_COLOUR;
            if (coloured == null || coloured.isPossible(k)) {
                cast(robot, x, y, cos, sin, image, k, TiledScene.CAMERA_RANGE_M);
                colour = hitColour();
            }
            if (colour != runColour) {
                endRun(robot, runColour, runFirst, k);
                runColour = colour;
                runFirst = k;
            }
        }
        endRun(robot, runColour, runFirst, TiledScene.COLUMNS);
    }

    private void endRun(int robot, int colour, int first, int end) {
        if (colour != NO_COLOUR && TiledScene.isColoured(colour)) {
            readings.addRun(robot, first, end - 1);
        }
    }

    private double cast(int robot, double x, double y, double cos, double sin, Fan fan, int k, double maxM) {
        return cast(
                robot,
                x + cos * fan.x[k] - sin * fan.y[k],
                y + sin * fan.x[k] + cos * fan.y[k],
                cos * fan.dirX[k] - sin * fan.dirY[k],
                sin * fan.dirX[k] + cos * fan.dirY[k],
                maxM);
    }

    @Override
    public final Readings readings() {
        return readings;
    }

    /**
     * The columns of an image in which a coloured object can be, if nothing hides it. The other columns need no ray.
     */
    private static final class ColouredColumns {
        private final double[] x;
        private final double[] y;
        private final double halfFovRad;
        private final double columnRad;
        private final boolean[] possible = new boolean[TiledScene.COLUMNS];

        ColouredColumns(WorldSpec spec, BlobfinderSpec camera) {
            List<ObstacleSpec> objects = spec.obstacles().stream()
                    .filter(each -> TiledScene.isColoured(each.colour()))
                    .toList();
            x = objects.stream().mapToDouble(each -> each.pose().x()).toArray();
            y = objects.stream().mapToDouble(each -> each.pose().y()).toArray();
            halfFovRad = camera.fovRad() / 2;
            columnRad = camera.fovRad() / camera.widthPx();
        }

        /** Finds the columns for a position and a direction. */
        void seek(double fromX, double fromY, double cos, double sin) {
            Arrays.fill(possible, false);
            double reachM = TiledScene.CAMERA_RANGE_M + TiledScene.COLOURED_RADIUS_M;
            for (int i = 0; i < x.length; i++) {
                double dx = x[i] - fromX;
                double dy = y[i] - fromY;
                double squareM2 = dx * dx + dy * dy;
                if (squareM2 < reachM * reachM) {
                    double ahead = dx * cos + dy * sin;
                    double aside = dy * cos - dx * sin;
                    mark(Math.atan2(aside, ahead), Math.sqrt(squareM2));
                }
            }
        }

        private void mark(double leftRad, double distanceM) {
            double halfRad = distanceM <= TiledScene.COLOURED_RADIUS_M
                    ? Math.PI
                    : Math.asin(TiledScene.COLOURED_RADIUS_M / distanceM);
            int first = (int) Math.floor((halfFovRad - leftRad - halfRad) / columnRad) - 1;
            int last = (int) Math.ceil((halfFovRad - leftRad + halfRad) / columnRad) + 1;
            for (int k = Math.max(0, first); k <= Math.min(possible.length - 1, last); k++) {
                possible[k] = true;
            }
        }

        boolean isPossible(int column) {
            return possible[column];
        }
    }
}
