package io.troupe.sim.device;

import org.jspecify.annotations.Nullable;

/**
 * A fan of at most {@value #MOST_RAYS} rays, with a table of those that may meet a circle, by the bearing of its centre
 * from the robot and by its size seen from there.
 *
 * <p><b>Source.</b> A ray that starts at most {@code o} from the robot's origin meets a circle of radius {@code r} at
 * distance {@code d} only if its direction differs from the bearing of the centre by at most {@code asin(r / (d - o)) +
 * asin(o / d)}, which is at most {@code asin((r + o) / (d - o))}. Bearings are counted by {@code left / (|ahead| +
 * |left|)}, which needs no arc tangent.
 */
final class FanSectors {
    static final int MOST_RAYS = 64;

    private static final int SECTORS = 64; // of the full circle
    private static final int SIZES = 16;
    /** Larger than rounding errors. */
    private static final double MARGIN_RAD = 1e-6;

    final RayFan fan;
    /** How far from the robot's origin a ray begins, at most. */
    final double offsetM;
    /** How far to the left of a ray's line the robot's origin lies. */
    final double[] aside;
    /** How far before the robot's origin, along its direction, a ray begins. */
    final double[] before;

    private final long all;
    private final long[] masks = new long[SECTORS * SIZES];

    /** The table of a fan; null if it has too many rays. */
    static @Nullable FanSectors of(RayFan fan) {
        return fan.size() > MOST_RAYS ? null : new FanSectors(fan);
    }

    private FanSectors(RayFan fan) {
        this.fan = fan;
        int rays = fan.size();
        aside = new double[rays];
        before = new double[rays];
        double farthestM = 0;
        for (int i = 0; i < rays; i++) {
            aside[i] = fan.dirX[i] * fan.y[i] - fan.dirY[i] * fan.x[i];
            before[i] = fan.dirX[i] * fan.x[i] + fan.dirY[i] * fan.y[i];
            farthestM = Math.max(farthestM, StrictMath.hypot(fan.x[i], fan.y[i]));
            double headingRad = StrictMath.atan2(fan.dirY[i], fan.dirX[i]);
            for (int sector = 0; sector < SECTORS; sector++) {
                double offRad = distanceRad(headingRad, bearingRad(sector), bearingRad(sector + 1));
                for (int size = 0; size < SIZES; size++) {
                    if (offRad <= StrictMath.asin((size + 1.0) / SIZES) + MARGIN_RAD) {
                        masks[sector * SIZES + size] |= 1L << i;
                    }
                }
            }
        }
        offsetM = farthestM;
        all = rays == MOST_RAYS ? -1 : (1L << rays) - 1;
    }

    /** The bearing at which a sector begins. */
    private static double bearingRad(int sector) {
        double count = 4.0 * sector / SECTORS - 2;
        if (Math.abs(count) <= 1) {
            return StrictMath.atan2(count, 1 - Math.abs(count));
        }
        double rad = StrictMath.atan2(2 - Math.abs(count), 1 - Math.abs(count));
        return Math.copySign(rad, count);
    }

    /** How far a direction is from those between two bearings. */
    private static double distanceRad(double headingRad, double fromRad, double toRad) {
        double halfRad = (toRad - fromRad) / 2;
        double middleRad = fromRad + halfRad;
        double offRad = Math.abs(StrictMath.IEEEremainder(headingRad - middleRad, 2 * StrictMath.PI));
        return Math.max(0, offRad - halfRad);
    }

    /**
     * The rays that may meet a circle: a bit for each. It may contain too many rays, never too few.
     *
     * @param ahead of the centre in the robot's frame
     * @param left of the centre
     * @param distanceM of the centre from the robot's origin
     */
    long mayMeet(double ahead, double left, double distanceM, double radiusM) {
        double nearestM = distanceM - offsetM;
        double extentM = radiusM + offsetM;
        if (extentM >= nearestM) {
            return all;
        }
        double count = left / (Math.abs(ahead) + Math.abs(left));
        if (ahead < 0) {
            count = left >= 0 ? 2 - count : -2 - count;
        }
        int sector = Math.min((int) ((count + 2) * (SECTORS / 4.0)), SECTORS - 1);
        int size = Math.min((int) (extentM / nearestM * SIZES), SIZES - 1);
        return masks[sector * SIZES + size];
    }
}
