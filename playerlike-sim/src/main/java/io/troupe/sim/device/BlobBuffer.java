package io.troupe.sim.device;

import java.util.Arrays;

/** Growing arrays of blobs, reused for each image. */
final class BlobBuffer {
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
