package io.troupe.bench.worlds;

import io.troupe.sim.scenario.WorldSpec;
import java.util.List;
import java.util.stream.Stream;

/** Whether the contenders simulate the same scene: what their robots sense after a second in which nobody drives. */
final class Agreement {
    /** More than this would not be rounding, and not a body's skin either. */
    static final double TOLERANCE_M = 0.02;

    private static final int INTERVALS = 1000 / TiledScene.INTERVAL_MILLIS;

    private Agreement() {}

    /**
     * The largest difference between a sonar reading of ours and one of another contender.
     *
     * <p><b>Errors.</b> {@link IllegalStateException} if two readings differ by more than {@link #TOLERANCE_M}, or two images by more than a column.
     */
    static double check(int robotCount) {
        WorldSpec spec = TiledScene.of(robotCount);
        List<Readings> all = Stream.of(WorldKind.values())
                .map(kind -> afterOneSecond(kind, spec))
                .toList();
        double largestM = 0;
        for (int i = 1; i < all.size(); i++) {
            for (int robot = 0; robot < robotCount; robot++) {
                String where = WorldKind.values()[i].label() + ", robot " + robot + " of " + robotCount;
                largestM = Math.max(largestM, sonars(where, robot, all.getFirst(), all.get(i)));
                images(where, robot, all.getFirst(), all.get(i));
            }
        }
        return largestM;
    }

    private static Readings afterOneSecond(WorldKind kind, WorldSpec spec) {
        BenchWorld world = kind.create(spec, false);
        world.advance(INTERVALS);
        return world.readings();
    }

    private static double sonars(String where, int robot, Readings ours, Readings theirs) {
        double largestM = 0;
        for (int k = 0; k < TiledScene.SONARS; k++) {
            double differenceM = Math.abs(ours.sonarM(robot, k) - theirs.sonarM(robot, k));
            if (!(differenceM <= TOLERANCE_M)) {
                throw new IllegalStateException(where + ", sonar " + k + ": " + theirs.sonarM(robot, k)
                        + " m, expected " + ours.sonarM(robot, k) + " m as in ours");
            }
            largestM = Math.max(largestM, differenceM);
        }
        return largestM;
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
