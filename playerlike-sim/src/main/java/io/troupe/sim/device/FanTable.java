package io.troupe.sim.device;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;

/**
 * Up to sixteen rays of a fan, with tables of those that may meet a circle, by the place of its centre in the robot's
 * frame.
 *
 * <p><b>Structure.</b> A table has square cells around the robot's origin, and for each cell a bit for every ray that
 * comes near enough to it. There is a table for each of a few sizes of circles. So a circle costs a look-up, without a
 * root or a division. The cells at the rim also stand for everything beyond them.
 *
 * <p><b>Threads.</b> Any. Tables are computed when they are first needed, and shared by all robots with the same fan.
 */
final class FanTable {
    /** Fans of more rays have no tables: they walk through the grid. */
    static final int MOST_RAYS = 64;

    private static final int RAYS = Character.SIZE;
    /** Cells of a table along each axis. */
    private static final int SIDE = 64;
    /** The greatest radius of each size of circles. */
    private static final double[] RADII_M = {0.15, 0.3, 0.55, 1.05, Double.POSITIVE_INFINITY};
    /** Larger than rounding errors. */
    private static final double MARGIN_M = 1e-6;

    final RayFan fan;
    /** The first of the rays in the fan. */
    final int firstRay;
    /** How far from the robot's origin a ray begins, at most. */
    final double offsetM;
    /** By ray of the fan, how far to the left of its line the robot's origin lies. */
    final double[] aside;
    /** By ray of the fan, how far before the robot's origin, along its direction, it begins. */
    final double[] before;

    private final int endRay;
    private final double maxM;
    private volatile Tables tables;

    /** The tables computed so far, by size. */
    private record Tables(int sizes, char[][] masks) {}

    /** The tables of a fan whose rays go this far; none if it has too many rays. */
    static List<FanTable> of(RayFan fan, double maxM) {
        if (fan.size() > MOST_RAYS) {
            return List.of();
        }
        double[] aside = new double[fan.size()];
        double[] before = new double[fan.size()];
        double farthestM = 0;
        for (int i = 0; i < fan.size(); i++) {
            aside[i] = fan.dirX[i] * fan.y[i] - fan.dirY[i] * fan.x[i];
            before[i] = fan.dirX[i] * fan.x[i] + fan.dirY[i] * fan.y[i];
            farthestM = Math.max(farthestM, StrictMath.hypot(fan.x[i], fan.y[i]));
        }
        List<FanTable> parts = new ArrayList<>();
        for (int first = 0; first < fan.size(); first += RAYS) {
            parts.add(new FanTable(fan, first, maxM, farthestM, aside, before));
        }
        return parts;
    }

    private FanTable(RayFan fan, int firstRay, double maxM, double offsetM, double[] aside, double[] before) {
        this.fan = fan;
        this.firstRay = firstRay;
        this.maxM = maxM;
        this.offsetM = offsetM;
        this.aside = aside;
        this.before = before;
        endRay = Math.min(fan.size(), firstRay + RAYS);
        tables = new Tables(0, new char[RADII_M.length][]);
    }

    /** The size of a circle. */
    static byte size(double radiusM) {
        int size = 0;
        while (radiusM > RADII_M[size]) {
            size++;
        }
        return (byte) size;
    }

    /** The bit of a size in {@link #masks}. */
    static int bit(byte size) {
        return 1 << size;
    }

    /**
     * The tables, by size: at {@link #index}, a bit for each ray that may meet a circle there. There may be too many
     * rays, never too few.
     *
     * @param sizes those that are needed, a {@link #bit} for each
     */
    char[][] masks(int sizes) {
        Tables known = tables;
        return (known.sizes & sizes) == sizes ? known.masks : compute(sizes);
    }

    private synchronized char[][] compute(int sizes) {
        char[][] masks = tables.masks.clone();
        for (int size = 0; size < RADII_M.length; size++) {
            if ((sizes & 1 << size) != 0 && masks[size] == null) {
                masks[size] = table(RADII_M[size]);
            }
        }
        tables = new Tables(tables.sizes | sizes, masks);
        return masks;
    }

    /** Cells per metre of the tables, all of which reach as far as that of the largest finite circle. */
    double cellsPerM() {
        return (SIDE / 2 - 1) / (maxM + offsetM + RADII_M[RADII_M.length - 2]);
    }

    /** Where the entry of a circle is. */
    static int index(double ahead, double left, double cellsPerM) {
        int row = (int) (ahead * cellsPerM + SIDE / 2.0); // rounds towards zero, and the cells at the rim are equal
        int column = (int) (left * cellsPerM + SIDE / 2.0);
        return Math.min(Math.max(row, 0), SIDE - 1) * SIDE + Math.min(Math.max(column, 0), SIDE - 1);
    }

    private char[] table(double radiusM) {
        char[] masks = new char[SIDE * SIDE];
        if (radiusM == Double.POSITIVE_INFINITY) {
            Arrays.fill(masks, (char) ((1 << endRay - firstRay) - 1));
            return masks;
        }
        double cellM = 1 / cellsPerM();
        double nearM = radiusM + cellM * StrictMath.sqrt(0.5) + MARGIN_M; // from a ray to the centre of a cell
        for (int ray = firstRay; ray < endRay; ray++) {
            var capsule = new Capsule(fan, ray, maxM, nearM);
            for (int row = 1; row < SIDE - 1; row++) {
                double ahead = (row + 0.5 - SIDE / 2.0) * cellM;
                if (capsule.crosses(ahead)) {
                    double middle = SIDE / 2.0 - 0.5;
                    int first = Math.max(1, (int) Math.ceil(capsule.fromLeft / cellM + middle - MARGIN_M));
                    int last = Math.min(SIDE - 2, (int) Math.floor(capsule.toLeft / cellM + middle + MARGIN_M));
                    for (int column = first; column <= last; column++) {
                        masks[row * SIDE + column] |= (char) (1 << ray - firstRay);
                    }
                }
            }
        }
        return masks;
    }

    /** All points that are at most so far from a ray. */
    private static final class Capsule {
        private final double x;
        private final double y;
        private final double dirX;
        private final double dirY;
        private final double lengthM;
        private final double radiusM;
        private double fromLeft; // where it meets the line that was asked for last
        private double toLeft;

        Capsule(RayFan fan, int ray, double lengthM, double radiusM) {
            x = fan.x[ray];
            y = fan.y[ray];
            dirX = fan.dirX[ray];
            dirY = fan.dirY[ray];
            this.lengthM = lengthM;
            this.radiusM = radiusM;
        }

        /** True if it meets the line of all points that are so far ahead. */
        boolean crosses(double ahead) {
            fromLeft = Double.POSITIVE_INFINITY;
            toLeft = Double.NEGATIVE_INFINITY;
            addEnd(x, y, ahead);
            addEnd(x + lengthM * dirX, y + lengthM * dirY, ahead);
            addSide(x - radiusM * dirY, y + radiusM * dirX, ahead);
            addSide(x + radiusM * dirY, y - radiusM * dirX, ahead);
            return fromLeft <= toLeft;
        }

        private void addEnd(double endX, double endY, double ahead) {
            double off = ahead - endX;
            if (Math.abs(off) <= radiusM) {
                double half = Math.sqrt(radiusM * radiusM - off * off);
                add(endY - half, endY + half);
            }
        }

        private void addSide(double sideX, double sideY, double ahead) {
            double share = (ahead - sideX) / (lengthM * dirX); // infinite or no number if they are parallel
            if (share >= 0 && share <= 1) {
                double left = sideY + share * lengthM * dirY;
                add(left, left);
            }
        }

        private void add(double from, double to) {
            fromLeft = Math.min(fromLeft, from);
            toLeft = Math.max(toLeft, to);
        }
    }
}
