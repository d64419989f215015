package io.troupe.player.structures.camera;

/** Data of the Player interface camera. */
public class PlayerCameraData {
    private int width;
    private int height;
    private int bpp;
    private int format;
    private int fdiv;
    private int compression;
    private int image_count;
    private byte[] image = new byte[0];

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

    public synchronized int getBpp() {
        return bpp;
    }

    public synchronized void setBpp(int value) {
        bpp = value;
    }

    public synchronized int getFormat() {
        return format;
    }

    public synchronized void setFormat(int value) {
        format = value;
    }

    public synchronized int getFdiv() {
        return fdiv;
    }

    public synchronized void setFdiv(int value) {
        fdiv = value;
    }

    public synchronized int getCompression() {
        return compression;
    }

    public synchronized void setCompression(int value) {
        compression = value;
    }

    public synchronized int getImage_count() {
        return image_count;
    }

    public synchronized void setImage_count(int value) {
        image_count = value;
    }

    public synchronized byte[] getImage() {
        return image;
    }

    public synchronized void setImage(byte[] value) {
        image = value;
    }
}
