package io.troupe.sim.device;

import io.troupe.sim.scenario.BlobfinderSpec;
import io.troupe.sim.scenario.Pose;
import java.util.ArrayList;
import java.util.List;

/**
 * A robot's camera: one ray per image column; neighbouring columns of one colour are a blob.
 *
 * <p>A column sees the first visible thing within range, past the robot that carries the camera. What is not to be reported still
 * hides what is behind it. Columns where nothing is in range belong to no blob.
 *
 * <p><b>Units and shapes.</b> Column {@code i} of {@code n} looks along its centre, at the angle
 * {@code fov / 2 - (i + 0.5) * fov / n} left of the camera's heading. There is no third dimension: every thing counts as
 * 0.3 m high above and below the camera, seen at its mean distance, and rows are as tall as
 * {@code fov / heightPx}.
 */
public final class Blobfinder {
    private static final double HALF_HEIGHT_M = 0.3;
    private static final int NO_COLOUR = -1;

    private final BlobfinderSpec spec;
    private final RayFan fan;
    private final int[] things;
    private final double[] distancesM;

    public Blobfinder(BlobfinderSpec spec) {
        if (spec.widthPx() < 1 || spec.heightPx() < 1) {
            throw new IllegalArgumentException("blobfinder image is " + spec.widthPx() + " x " + spec.heightPx()
                    + ", expected at least one pixel each way");
        }
        if (!(spec.rangeM() > 0 && spec.rangeM() < 1e6)) {
            throw new IllegalArgumentException("blobfinder range is " + spec.rangeM() + ", expected metres above 0");
        }
        if (!(spec.fovRad() > 0 && spec.fovRad() <= 2 * StrictMath.PI)) {
            throw new IllegalArgumentException(
                    "blobfinder field of view is " + spec.fovRad() + " rad, expected above 0, at most a full turn");
        }
        this.spec = spec;
        List<Pose> columns = new ArrayList<>();
        for (int i = 0; i < spec.widthPx(); i++) {
            double leftRad = spec.fovRad() / 2 - (i + 0.5) * spec.fovRad() / spec.widthPx();
            columns.add(spec.mount().compose(new Pose(0, 0, leftRad)));
        }
        fan = new RayFan(columns);
        things = new int[fan.size()];
        distancesM = new double[fan.size()];
    }

    /** What the camera sees, from left to right. */
    public BlobImage read(Scene scene, int robot) {
        scene.cast(robot, fan, Ray.SIGHT, spec.rangeM(), things, distancesM);
        List<Blob> blobs = new ArrayList<>();
        int left = 0;
        while (left < things.length) {
            int colour = colour(scene, left);
            int right = left;
            double sumM = distancesM[left];
            while (right + 1 < things.length && colour(scene, right + 1) == colour) {
                right++;
                sumM += distancesM[right];
            }
            if (isReported(colour)) {
                blobs.add(blob(colour, left, right, sumM / (right - left + 1)));
            }
            left = right + 1;
        }
        return new BlobImage(spec.widthPx(), spec.heightPx(), blobs);
    }

    private int colour(Scene scene, int column) {
        return things[column] == Ray.NOTHING ? NO_COLOUR : scene.colour(things[column]);
    }

    private boolean isReported(int colour) {
        return colour != NO_COLOUR
                && (spec.colours().isEmpty() || spec.colours().contains(colour));
    }

    private Blob blob(int colour, int left, int right, double rangeM) {
        double rowRad = spec.fovRad() / spec.heightPx();
        int centre = spec.heightPx() / 2;
        int halfRows = (int) (StrictMath.atan2(HALF_HEIGHT_M, rangeM) / rowRad);
        int top = Math.max(0, centre - halfRows);
        int bottom = Math.min(spec.heightPx(), centre + halfRows);
        int areaPx2 = (right - left) * (bottom - top);
        return new Blob(colour, areaPx2, left + (right - left) / 2, centre, left, right, top, bottom, rangeM);
    }
}
