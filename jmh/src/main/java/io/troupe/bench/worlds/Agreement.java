package io.troupe.bench.worlds;

import io.troupe.bench.worlds.BenchWorld.Readings;
import io.troupe.sim.model.WorldSpec;
import java.util.List;

/**
 * The agreement of the contenders on one scene: they must sense the same after a second in which no robot drives.
 *
 * @param largestM the largest difference between a range of ours and one of another contender, without grazing rays
 * @param grazing the number of rays that differ by more: they just touch a corner, which one contender hits and the
 *     other misses
 */
record Agreement(double largestM, int grazing) {
    /** Larger than rounding errors and the skin of a body. */
    static final double TOLERANCE_M = 0.02;

    private static final int INTERVALS = 1000 / TiledScene.INTERVAL_MILLIS;

    /** At most one ray in this many may graze in the full scene. */
    private static final int RAYS_PER_GRAZING = 5_000;

    /** The same in scenes with many more corners. */
    private static final int RAYS_PER_GRAZING_AMONG_CORNERS = 500;

    /**
     * Lets the contenders, ours first, simulate a second, and compares their readings.
     *
     * <p><b>Errors.</b> {@link IllegalStateException} if readings differ by more than {@link #TOLERANCE_M} in more than
     * one ray of 5,000 (of 500 in scenes with many corners), or two images by more than a column.
     */
    static Agreement check(BuildScene scene, int robotCount, List<WorldKind> contenders) {
        WorldSpec spec = scene.spec(robotCount);
        List<Readings> all =
                contenders.stream().map(kind -> afterOneSecond(kind, spec)).toList();
        int raysPerGrazing = scene == BuildScene.FULL ? RAYS_PER_GRAZING : RAYS_PER_GRAZING_AMONG_CORNERS;
        double largestM = 0;
        int grazing = 0;
        for (int i = 1; i < all.size(); i++) {
            for (int robot = 0; robot < robotCount; robot++) {
                String where = contenders.get(i).label() + ", robot " + robot + " of " + robotCount;
                images(where, robot, all.getFirst(), all.get(i));
                int rays = all.get(i).rays;
                for (int k = 0; k < rays; k++) {
                    double ours = all.getFirst().rangeM(robot, k);
                    double theirs = all.get(i).rangeM(robot, k);
                    if (Math.abs(ours - theirs) <= TOLERANCE_M) {
                        largestM = Math.max(largestM, Math.abs(ours - theirs));
                    } else if (++grazing > robotCount * rays / raysPerGrazing) {
                        throw new IllegalStateException(
                                where + ", ray " + k + ": " + theirs + " m, expected " + ours + " m as in ours");
                    }
                }
            }
        }
        return new Agreement(largestM, grazing);
    }

    private static Readings afterOneSecond(WorldKind kind, WorldSpec spec) {
        BenchWorld world = kind.create(spec, false);
        world.advance(INTERVALS);
        return world.readings();
    }

    private static void images(String where, int robot, Readings ours, Readings theirs) {
        int left = Math.abs(ours.colouredLeft[robot] - theirs.colouredLeft[robot]);
        int right = Math.abs(ours.colouredRight[robot] - theirs.colouredRight[robot]);
        if (left > 1 || right > 1) {
            throw new IllegalStateException(where + ": " + theirs.colouredLeft[robot] + " and "
                    + theirs.colouredRight[robot] + " coloured columns left and right, expected "
                    + ours.colouredLeft[robot] + " and " + ours.colouredRight[robot] + " as in ours");
        }
    }
}
