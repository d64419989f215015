package io.troupe.player.structures.blobfinder;

/** Settings of a blobfinder's camera; -1 leaves a value unchanged. */
public class PlayerBlobfinderImagerConfig {
    private int brightness;
    private int contrast;
    private int colormode;
    private int autogain;

    public synchronized int getBrightness() {
        return brightness;
    }

    public synchronized void setBrightness(int value) {
        brightness = value;
    }

    public synchronized int getContrast() {
        return contrast;
    }

    public synchronized void setContrast(int value) {
        contrast = value;
    }

    public synchronized int getColormode() {
        return colormode;
    }

    public synchronized void setColormode(int value) {
        colormode = value;
    }

    public synchronized int getAutogain() {
        return autogain;
    }

    public synchronized void setAutogain(int value) {
        autogain = value;
    }
}
