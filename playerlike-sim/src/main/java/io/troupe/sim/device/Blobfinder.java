package io.troupe.sim.device;

import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.Pose;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.stream.IntStream;

/**
 * A robot's camera with one ray per image column; neighbouring columns of one colour form a blob.
 *
 * <p>A column sees the first visible thing within range, ignoring the robot that carries the camera. A thing whose
 * colour is not reported still hides what is behind it. Columns with nothing in range belong to no blob.
 *
 * <p><b>Cost.</b> A camera that reports only some colours casts only the columns in which a thing of such a colour can
 * be.
 *
 * <p><b>Units and shapes.</b> Column {@code i} of {@code n} looks along its centre, at the angle {@code fov / 2 - (i +
 * 0.5) * fov / n} left of the camera's heading. The world is flat: every thing counts as reaching 0.3 m above and below
 * the camera, at its mean distance. Rows are as tall as {@code fov / heightPx}.
 */
public final class Blobfinder {
    private static final double HALF_HEIGHT_M = 0.3;
    private static final int NO_COLOUR = -1;

    private final BlobfinderSpec spec;
    private final RayFan fan;
    private final int[] reported; // sorted; empty = all
    private final BlobBuffer blobs = new BlobBuffer();

    public Blobfinder(BlobfinderSpec spec) {
        this(
                check(spec),
                columns(spec),
                spec.colours().stream().mapToInt(Integer::intValue).sorted().toArray());
    }

    private Blobfinder(BlobfinderSpec spec, RayFan fan, int[] reported) {
        this.spec = spec;
        this.fan = fan;
        this.reported = reported;
    }

    private static BlobfinderSpec check(BlobfinderSpec spec) {
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
        return spec;
    }

    private static RayFan columns(BlobfinderSpec spec) {
        List<Pose> columns = new ArrayList<>();
        for (int i = 0; i < spec.widthPx(); i++) {
            double leftRad = spec.fovRad() / 2 - (i + 0.5) * spec.fovRad() / spec.widthPx();
            columns.add(spec.mount().compose(new Pose(0, 0, leftRad)));
        }
        return new RayFan(columns);
    }

    /** Creates another camera of this specification, with separate readings; the immutable tables are shared. */
    public Blobfinder twin() {
        return new Blobfinder(spec, fan, reported);
    }

    /** Reads the camera; allocates nothing once it has seen as many blobs. */
    public void sense(Scene scene, int robot, Scratch scratch) {
        blobs.clear();
        scratch.fit(fan.size());
        if (reported.length == 0) {
            scene.cast(robot, fan, Ray.SIGHT, spec.rangeM(), scratch);
        } else if (!scene.seek(robot, fan, spec.fovRad() <= StrictMath.PI, reported, spec.rangeM(), scratch)) {
            return;
        }
        int[] things = scratch.things();
        double[] distancesM = scratch.distancesM();
        int left = 0;
        while (left < fan.size()) {
            int colour = colour(scene, things[left]);
            int right = left;
            double sumM = distancesM[left];
            while (right + 1 < fan.size() && colour(scene, things[right + 1]) == colour) {
                right++;
                sumM += distancesM[right];
            }
            if (isReported(colour)) {
                blobs.add(colour, left, right, sumM / (right - left + 1));
            }
            left = right + 1;
        }
    }

    private static int colour(Scene scene, int thing) {
        return thing == Ray.NOTHING ? NO_COLOUR : scene.colour(thing);
    }

    private boolean isReported(int colour) {
        return colour != NO_COLOUR && (reported.length == 0 || Arrays.binarySearch(reported, colour) >= 0);
    }

    /** Number of blobs in the last image; they are counted from the left. */
    public int count() {
        return blobs.count;
    }

    /** Colour of a blob, {@code 0x00RRGGBB}. */
    public int colour(int blob) {
        return blobs.colour[blob];
    }

    /** First column of a blob. */
    public int left(int blob) {
        return blobs.left[blob];
    }

    /** Last column of a blob. */
    public int right(int blob) {
        return blobs.right[blob];
    }

    /** Mean distance of a blob's columns. */
    public double rangeM(int blob) {
        return blobs.rangeM[blob];
    }

    /** First row of a blob. */
    public int top(int blob) {
        return Math.max(0, spec.heightPx() / 2 - halfRows(blob));
    }

    /** Row after the last row of a blob. */
    public int bottom(int blob) {
        return Math.min(spec.heightPx(), spec.heightPx() / 2 + halfRows(blob));
    }

    private int halfRows(int blob) {
        double rowRad = spec.fovRad() / spec.heightPx();
        return (int) (StrictMath.atan2(HALF_HEIGHT_M, blobs.rangeM[blob]) / rowRad);
    }

    /** The last image, with blobs from left to right. */
    public BlobImage image() {
        return new BlobImage(
                spec.widthPx(),
                spec.heightPx(),
                blobs.count == 0
                        ? List.of()
                        : IntStream.range(0, blobs.count).mapToObj(this::blob).toList());
    }

    private ColourBlob blob(int i) {
        int left = left(i);
        int right = right(i);
        int top = top(i);
        int bottom = bottom(i);
        int areaPx2 = (right - left) * (bottom - top);
        int centre = spec.heightPx() / 2;
        return new ColourBlob(
                colour(i), areaPx2, left + (right - left) / 2, centre, left, right, top, bottom, rangeM(i));
    }

    /** Reads the camera and returns the image, with blobs from left to right. */
    public BlobImage read(Scene scene, int robot) {
        sense(scene, robot, new Scratch());
        return image();
    }

    /** Growing arrays of blobs, reused for each image. */
    private static final class BlobBuffer {
        private static final int FIRST_LENGTH = 4;

        int[] colour = new int[FIRST_LENGTH];
        int[] left = new int[FIRST_LENGTH];
        int[] right = new int[FIRST_LENGTH];
        double[] rangeM = new double[FIRST_LENGTH];
        int count;

        void clear() {
            count = 0;
        }

        void add(int blobColour, int firstColumn, int lastColumn, double meanRangeM) {
            if (count == colour.length) {
                colour = Arrays.copyOf(colour, 2 * count);
                left = Arrays.copyOf(left, 2 * count);
                right = Arrays.copyOf(right, 2 * count);
                rangeM = Arrays.copyOf(rangeM, 2 * count);
            }
            colour[count] = blobColour;
            left[count] = firstColumn;
            right[count] = lastColumn;
            rangeM[count] = meanRangeM;
            count++;
        }
    }
}
