package io.troupe.services.behaviour;

import io.troupe.player.structures.blobfinder.PlayerBlobfinderBlob;
import io.troupe.player.structures.blobfinder.PlayerBlobfinderData;
import java.util.AbstractList;
import java.util.List;
import java.util.RandomAccess;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/**
 * A patch of one colour in a camera's image.
 *
 * <p><b>Units and shapes.</b> Pixels: columns count from 0 at the left, rows from 0 at the top. The Player protocol
 * does not carry the angle that the image covers, so a bearing needs the camera's field of view from the world file or
 * the data sheet; {@link #offset} needs no angle.
 *
 * @param colour {@code 0x00RRGGBB}
 * @param areaPx2 area as the camera reports it
 * @param leftPx first column
 * @param rightPx last column
 * @param topPx first row
 * @param bottomPx last row; in our worlds, which have no third dimension, the row after it
 * @param imageWidthPx columns of the whole image
 * @param imageHeightPx rows of the whole image
 * @param rangeM mean distance from the camera in metres; 0 if the camera does not measure it
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
    /**
     * Converts the data of a Player blobfinder, in the same order.
     *
     * <p><b>Cost.</b> The blobs are converted when the list is first read: most behaviours do not look at them. They
     * must not be changed before that; the client makes new ones for each image.
     */
    public static List<Blob> of(PlayerBlobfinderData image) {
        var seen = image.getBlobs();
        return seen.length == 0 ? List.of() : new ConvertedBlobs(seen, image.getWidth(), image.getHeight());
    }

    /** An immutable copy of a list; of a list that {@link #of} has returned, the same one, still unread. */
    static List<Blob> copyOf(List<Blob> blobs) {
        return blobs instanceof ConvertedBlobs ? blobs : List.copyOf(blobs);
    }

    /**
     * The horizontal position of the blob's centre: 1 at the left edge of the image, 0 in the middle, -1 at the right
     * edge; also 0 if the camera does not report the width of its image.
     */
    public double offset() {
        return imageWidthPx <= 0 ? 0 : 1 - (leftPx + rightPx + 1.0) / imageWidthPx;
    }

    /**
     * The direction of the blob's centre from the camera's axis, left positive. Valid for a camera whose columns cover
     * equal angles, as in our worlds.
     *
     * @param fieldOfViewRad angle from the left to the right edge of the image
     */
    public double bearingRad(double fieldOfViewRad) {
        return offset() * fieldOfViewRad / 2;
    }

    /** The blobs of an image; converted at the first access, by any thread. */
    private static final class ConvertedBlobs extends AbstractList<Blob> implements RandomAccess {
        private final PlayerBlobfinderBlob[] seen;
        private final int imageWidthPx;
        private final int imageHeightPx;
        private @Nullable List<Blob> blobs; // an immutable list, so a race leads to a second, equal one at most

        ConvertedBlobs(PlayerBlobfinderBlob[] seen, int imageWidthPx, int imageHeightPx) {
            this.seen = seen;
            this.imageWidthPx = imageWidthPx;
            this.imageHeightPx = imageHeightPx;
        }

        private List<Blob> blobs() {
            List<Blob> converted = blobs;
            if (converted == null) {
                converted = Stream.of(seen).map(this::converted).toList();
                blobs = converted;
            }
            return converted;
        }

        private Blob converted(PlayerBlobfinderBlob blob) {
            return new Blob(
                    blob.getColor(),
                    blob.getArea(),
                    blob.getLeft(),
                    blob.getRight(),
                    blob.getTop(),
                    blob.getBottom(),
                    imageWidthPx,
                    imageHeightPx,
                    blob.getRange());
        }

        @Override
        public Blob get(int index) {
            return blobs().get(index);
        }

        @Override
        public int size() {
            return blobs().size();
        }

        @Override
        public Stream<Blob> stream() {
            return blobs().stream();
        }
    }
}
