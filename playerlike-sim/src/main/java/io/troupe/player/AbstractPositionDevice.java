package io.troupe.player;

/** A device that has a position and can be driven. */
public abstract class AbstractPositionDevice extends PlayerDevice {
    protected AbstractPositionDevice(PlayerClient client) {
        super(client);
    }

    /** Metres, in the odometry frame. */
    public abstract double getX();

    /** Metres, in the odometry frame. */
    public abstract double getY();

    /** Radians, left positive. */
    public abstract double getYaw();

    /**
     * Drives at a speed in metres per second and a turn rate in radians per second (left positive) until the next
     * command.
     */
    public abstract void setSpeed(double speed, double turnrate);
}
