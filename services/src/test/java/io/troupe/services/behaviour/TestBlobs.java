package io.troupe.services.behaviour;

/** Blobs for tests in which only colour, area and horizontal position matter. */
public final class TestBlobs {
    private TestBlobs() {}

    /** A blob one column wide in an image of 80 by 60 pixels. */
    public static Blob of(int colour, int areaPx2, int leftPx) {
        return new Blob(colour, areaPx2, leftPx, leftPx, 25, 35, 80, 60, 1);
    }
}
