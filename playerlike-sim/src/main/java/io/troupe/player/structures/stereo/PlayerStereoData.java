package io.troupe.player.structures.stereo;

import io.troupe.player.structures.camera.PlayerCameraData;

/** Data of the Player interface stereo. This client does not use it. */
public class PlayerStereoData {
    private PlayerCameraData leftChannel = new PlayerCameraData();
    private PlayerCameraData rightChannel = new PlayerCameraData();
    private PlayerCameraData disparity = new PlayerCameraData();
    private int points_count;
    private PlayerPointCloud3dStereoElement[] points = new PlayerPointCloud3dStereoElement[0];
    private int mode;

    public synchronized PlayerCameraData getLeftChannel() {
        return leftChannel;
    }

    public synchronized void setLeftChannel(PlayerCameraData value) {
        leftChannel = value;
    }

    public synchronized PlayerCameraData getRightChannel() {
        return rightChannel;
    }

    public synchronized void setRightChannel(PlayerCameraData value) {
        rightChannel = value;
    }

    public synchronized PlayerCameraData getDisparity() {
        return disparity;
    }

    public synchronized void setDisparity(PlayerCameraData value) {
        disparity = value;
    }

    public synchronized int getPoints_count() {
        return points_count;
    }

    public synchronized void setPoints_count(int value) {
        points_count = value;
    }

    public synchronized PlayerPointCloud3dStereoElement[] getPoints() {
        return points;
    }

    public synchronized void setPoints(PlayerPointCloud3dStereoElement[] value) {
        points = value;
    }

    public synchronized int getMode() {
        return mode;
    }

    public synchronized void setMode(int value) {
        mode = value;
    }
}
