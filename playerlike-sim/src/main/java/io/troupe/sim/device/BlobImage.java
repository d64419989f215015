package io.troupe.sim.device;

import java.util.List;

/** The blobs in a blobfinder's image, from left to right. */
public record BlobImage(int widthPx, int heightPx, List<ColourBlob> blobs) {
    public BlobImage {
        blobs = List.copyOf(blobs);
    }
}
