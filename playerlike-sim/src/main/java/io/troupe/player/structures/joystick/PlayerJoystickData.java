package io.troupe.player.structures.joystick;

/** Data of the Player interface joystick. This client does not use it. */
public class PlayerJoystickData {
    private int[] pos = new int[8];
    private int[] scale = new int[8];
    private int buttons;
    private int axesCount;

    public synchronized int[] getPos() {
        return pos;
    }

    public synchronized void setPos(int[] value) {
        pos = value;
    }

    public synchronized int[] getScale() {
        return scale;
    }

    public synchronized void setScale(int[] value) {
        scale = value;
    }

    public synchronized int getButtons() {
        return buttons;
    }

    public synchronized void setButtons(int value) {
        buttons = value;
    }

    public synchronized int getAxesCount() {
        return axesCount;
    }

    public synchronized void setAxesCount(int value) {
        axesCount = value;
    }

    public synchronized int getPos(int axis) {
        return pos[axis];
    }

    public synchronized void setPos(int axis, int value) {
        pos[axis] = value;
    }

    public synchronized int getScale(int axis) {
        return scale[axis];
    }

    public synchronized void setScale(int axis, int value) {
        scale[axis] = value;
    }

    public synchronized int getXpos() {
        return pos[0];
    }

    public synchronized int getXscale() {
        return scale[0];
    }

    public synchronized int getYpos() {
        return pos[1];
    }

    public synchronized int getYscale() {
        return scale[1];
    }
}
