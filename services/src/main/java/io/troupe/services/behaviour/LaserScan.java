package io.troupe.services.behaviour;

import io.troupe.player.structures.laser.PlayerLaserData;

/**
 * One scan of a laser: one range per beam, from right to left.
 *
 * <p><b>Units and shapes.</b> Metres; a beam that hits nothing reads {@link #maxRangeM}. Bearings are radians from the
 * laser's axis, left positive; the axis is the robot's x axis unless the laser is mounted at an angle.
 */
public final class LaserScan {
    /** A scan without beams, for services that do not use the laser. */
    public static final LaserScan EMPTY = new LaserScan(0, 0, 0, new float[0]);

    private final double minBearingRad;
    private final double maxBearingRad;
    private final double maxRangeM;
    private final float[] rangesM;

    private LaserScan(double minBearingRad, double maxBearingRad, double maxRangeM, float[] rangesM) {
        this.minBearingRad = minBearingRad;
        this.maxBearingRad = maxBearingRad;
        this.maxRangeM = maxRangeM;
        this.rangesM = rangesM;
    }

    /**
     * Creates a scan from ranges at equal angles.
     *
     * @param minBearingRad bearing of the first beam
     * @param maxBearingRad bearing of the last beam
     * @param maxRangeM the laser's maximum range
     * @throws IllegalArgumentException if a range is not a number
     */
    public static LaserScan of(double minBearingRad, double maxBearingRad, double maxRangeM, float[] rangesM) {
        for (int beam = 0; beam < rangesM.length; beam++) {
            if (Float.isNaN(rangesM[beam])) {
                throw new IllegalArgumentException("laser beam " + beam + " reads NaN, expected metres");
            }
        }
        return new LaserScan(minBearingRad, maxBearingRad, maxRangeM, rangesM.clone());
    }

    /** Converts a scan of the Player client. */
    public static LaserScan of(PlayerLaserData scan) {
        return of(scan.getMin_angle(), scan.getMax_angle(), scan.getMax_range(), scan.getRanges());
    }

    /** The number of beams. */
    public int size() {
        return rangesM.length;
    }

    public boolean isEmpty() {
        return rangesM.length == 0;
    }

    /** The laser's maximum range. */
    public double maxRangeM() {
        return maxRangeM;
    }

    /** The range of a beam; beam 0 is the rightmost. */
    public double rangeM(int beam) {
        return rangesM[beam];
    }

    /** The bearing of a beam; beam 0 is the rightmost. */
    public double bearingRad(int beam) {
        return rangesM.length < 2
                ? (minBearingRad + maxBearingRad) / 2 // a single beam looks along the middle
                : minBearingRad + beam * ((maxBearingRad - minBearingRad) / (rangesM.length - 1));
    }

    /** The smallest range of the beams between two bearings; {@link #maxRangeM} if there is no beam between them. */
    public double nearestM(double fromRad, double toRad) {
        double nearestM = maxRangeM;
        for (int beam = 0; beam < rangesM.length; beam++) {
            double bearingRad = bearingRad(beam);
            if (bearingRad >= fromRad && bearingRad <= toRad) {
                nearestM = StrictMath.min(nearestM, rangesM[beam]);
            }
        }
        return nearestM;
    }

    @Override
    public String toString() {
        return "LaserScan[" + rangesM.length + " beams, " + minBearingRad + " to " + maxBearingRad + " rad]";
    }
}
