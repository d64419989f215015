package io.troupe.player.structures.position2d;

/** A command to drive like a car: metres per second and radians. */
public class PlayerPosition2dCmdCar {
    private double velocity;
    private double angle;

    public synchronized double getVelocity() {
        return velocity;
    }

    public synchronized void setVelocity(double value) {
        velocity = value;
    }

    public synchronized double getAngle() {
        return angle;
    }

    public synchronized void setAngle(double value) {
        angle = value;
    }
}
