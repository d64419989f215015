package io.troupe.services.behaviour;

import io.troupe.player.structures.blobfinder.PlayerBlobfinderData;
import java.util.ArrayList;
import java.util.List;

/**
 * A patch of one colour in a camera's image.
 *
 * <p><b>Units and shapes.</b> Pixels: columns count from 0 at the left, rows from 0 at the top. The Player protocol
 * does not say what angle the image covers, so a bearing needs the camera's field of view from the world file or the
 * data sheet; {@link #offset} does without.
 *
 * @param colour {@code 0x00RRGGBB}
 * @param areaPx2 as the camera reports it
 * @param leftPx its first column
 * @param rightPx its last column
 * @param topPx its first row
 * @param bottomPx its last row; in our worlds, which have no third dimension, the row after it
 * @param imageWidthPx columns of the whole image
 * @param imageHeightPx rows of the whole image
 * @param rangeM its mean distance from the camera in metres; 0 from a camera that does not measure it
 */
public record Blob(
        int colour,
        int areaPx2,
        int leftPx,
        int rightPx,
        int topPx,
        int bottomPx,
        int imageWidthPx,
        int imageHeightPx,
        double rangeM) {
    /** What a blobfinder of the Player client sees, in its order. */
    public static List<Blob> of(PlayerBlobfinderData image) {
        var seen = image.getBlobs();
        if (seen.length == 0) {
            return List.of(); // mostly, and for many robots many times a second
        }
        List<Blob> blobs = new ArrayList<>(seen.length);
        for (var blob : seen) {
            blobs.add(new Blob(
                    blob.getColor(),
                    blob.getArea(),
                    blob.getLeft(),
                    blob.getRight(),
                    blob.getTop(),
                    blob.getBottom(),
                    image.getWidth(),
                    image.getHeight(),
                    blob.getRange()));
        }
        return List.copyOf(blobs);
    }

    /**
     * Where its middle is across the image: 1 at the left edge, 0 in the middle, -1 at the right edge; 0 too if the
     * camera does not report the width of its image.
     */
    public double offset() {
        return imageWidthPx <= 0 ? 0 : 1 - (leftPx + rightPx + 1.0) / imageWidthPx;
    }

    /**
     * The direction of its middle from the camera's axis, left positive, for a camera whose columns cover equal angles,
     * as those of our worlds do.
     *
     * @param fieldOfViewRad angle from the left to the right edge of the image
     */
    public double bearingRad(double fieldOfViewRad) {
        return offset() * fieldOfViewRad / 2;
    }
}
