package io.troupe.player.structures.blobfinder;

/** The blobs of a camera image; width and height are 0 if there is no blob. */
public class PlayerBlobfinderData {
    private int width;
    private int height;
    private int blobs_count;
    private PlayerBlobfinderBlob[] blobs = new PlayerBlobfinderBlob[0];

    public synchronized int getWidth() {
        return width;
    }

    public synchronized void setWidth(int value) {
        width = value;
    }

    public synchronized int getHeight() {
        return height;
    }

    public synchronized void setHeight(int value) {
        height = value;
    }

    public synchronized int getBlobs_count() {
        return blobs_count;
    }

    public synchronized void setBlobs_count(int value) {
        blobs_count = value;
    }

    public synchronized PlayerBlobfinderBlob[] getBlobs() {
        return blobs;
    }

    public synchronized void setBlobs(PlayerBlobfinderBlob[] value) {
        blobs = value;
    }
}
