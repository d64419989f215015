package io.troupe.sim.device;

import io.troupe.sim.scenario.BlobfinderSpec;
import io.troupe.sim.scenario.Pose;
import java.util.ArrayList;
import java.util.List;

/**
 * A colour camera: one ray for each image column, neighbouring columns of one colour make a blob.
 *
 * <p><b>Units and shapes.</b> Column 0 is at the left edge; the ray of column c of w goes through the middle of the column,
 * {@code fov / 2 - (c + 1/2) * fov / w} left of the camera's axis. The height of a blob is that of a thing {@value #HEIGHT_M} m high at the blob's mean distance.
 * <p><b>Source.</b> Stage's blobfinder model; unlike it, this one skips no column after a blob, and areas are never negative.
 */
public final class Blobfinder {
    private static final double HEIGHT_M = 0.6;
    private static final int NOTHING = -1;

    private Blobfinder() {}

    /** What the camera of a robot with that index at that pose sees. */
    public static BlobImage read(BlobfinderSpec spec, Pose robot, int index, RayGrid grid) {
        Pose eye = robot.compose(spec.mount());
        double columnRad = spec.fovRad() / spec.widthPx();
        var blobs = new ArrayList<Blob>();
        int colour = NOTHING;
        int left = 0;
        double sumM = 0;
        for (int column = 0; column <= spec.widthPx(); column++) {
            double rangeM = 0;
            int seen = NOTHING;
            if (column < spec.widthPx()) {
                double heading = eye.headingRad() + spec.fovRad() / 2 - (column + 0.5) * columnRad;
                rangeM = grid.cast(eye.x(), eye.y(), heading, spec.rangeM(), index, RayGrid.FOR_CAMERAS);
                seen = grid.hit() && isReported(spec, grid.hitColour()) ? grid.hitColour() : NOTHING;
            }
            if (seen != colour || column == spec.widthPx()) {
                if (colour != NOTHING) {
                    blobs.add(blob(spec, colour, left, column - 1, sumM / (column - left)));
                }
                colour = seen;
                left = column;
                sumM = 0;
            }
            sumM += rangeM;
        }
        return new BlobImage(spec.widthPx(), spec.heightPx(), blobs);
    }

    private static boolean isReported(BlobfinderSpec spec, int colour) {
        List<Integer> wanted = spec.colours();
        return wanted.isEmpty() || wanted.contains(colour);
    }

    private static Blob blob(BlobfinderSpec spec, int colour, int left, int right, double rangeM) {
        int half = (int) (StrictMath.atan2(HEIGHT_M / 2, rangeM) / (spec.fovRad() / spec.heightPx()));
        int middle = spec.heightPx() / 2;
        int top = Math.clamp(middle - half, 0, spec.heightPx());
        int bottom = Math.clamp(middle + half, 0, spec.heightPx());
        return new Blob(
                colour,
                (right - left) * (bottom - top),
                left + (right - left) / 2,
                middle,
                left,
                right,
                top,
                bottom,
                rangeM);
    }
}
