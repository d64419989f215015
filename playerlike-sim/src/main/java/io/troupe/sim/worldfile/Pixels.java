package io.troupe.sim.worldfile;

import java.util.BitSet;

/** The dark pixels of a bitmap. Row 0 is the lowest, unlike in an image. */
final class Pixels {
    final int width;
    final int height;
    private final BitSet dark;

    Pixels(int width, int height) {
        this.width = width;
        this.height = height;
        dark = new BitSet(width * height);
    }

    void darken(int x, int y) {
        dark.set(y * width + x);
    }

    /** True if the pixel is dark; pixels outside the bitmap are not. */
    boolean isDark(int x, int y) {
        return x >= 0 && y >= 0 && x < width && y < height && dark.get(y * width + x);
    }

    int darkCount() {
        return dark.cardinality();
    }

    /** Bounding box of the dark pixels, in pixels; there must be at least one. */
    Box darkBox() {
        int minX = width;
        int maxX = 0;
        for (int at = dark.nextSetBit(0); at >= 0; at = dark.nextSetBit(at + 1)) {
            minX = Math.min(minX, at % width);
            maxX = Math.max(maxX, at % width + 1);
        }
        int minY = dark.nextSetBit(0) / width;
        int maxY = dark.previousSetBit(width * height - 1) / width + 1;
        return new Box(minX, minY, maxX, maxY);
    }

    /** The bitmap mirrored at its diagonal, so that columns become rows. */
    Pixels transposed() {
        var turned = new Pixels(height, width);
        for (int at = dark.nextSetBit(0); at >= 0; at = dark.nextSetBit(at + 1)) {
            turned.darken(at / width, at % width);
        }
        return turned;
    }
}
