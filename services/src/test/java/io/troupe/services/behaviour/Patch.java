package io.troupe.services.behaviour;

/** Blobs of which only colour, area and place matter. */
public final class Patch {
    private Patch() {}

    /** One column wide, in an image of 80 by 60 pixels. */
    public static Blob of(int colour, int areaPx2, int leftPx) {
        return new Blob(colour, areaPx2, leftPx, leftPx, 25, 35, 80, 60, 1);
    }
}
