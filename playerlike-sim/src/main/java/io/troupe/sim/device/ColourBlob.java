package io.troupe.sim.device;

/**
 * A run of neighbouring image columns of one colour.
 *
 * @param colour {@code 0x00RRGGBB}
 * @param areaPx2 (right - left) x (bottom - top), never negative
 * @param x centre column
 * @param y centre row
 * @param left first column; 0 is the left edge of the view
 * @param right last column
 * @param rangeM mean distance of its columns
 */
public record ColourBlob(
        int colour, int areaPx2, int x, int y, int left, int right, int top, int bottom, double rangeM) {}
