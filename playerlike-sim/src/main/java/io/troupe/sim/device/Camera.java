package io.troupe.sim.device;

import java.util.List;

/** A fan of rays from one point, placed in the world. It finds the rays that may meet a circle. */
final class Camera {
    int carrier; // number of the robot that carries it
    double rangeM;
    boolean found; // true if a ray was marked
    double x;
    double y;
    private double cos;
    private double sin;
    private RayFan fan = new RayFan(List.of());
    private boolean narrow; // at most half a turn from the first ray, which is the leftmost, to the last

    void place(int carrierThing, double robotX, double robotY, double robotCos, double robotSin) {
        carrier = carrierThing;
        cos = robotCos;
        sin = robotSin;
        x = robotX;
        y = robotY;
    }

    /** Sets the rays and the range; called after {@link #place}. */
    void look(RayFan rays, boolean atMostHalfTurn, double range) {
        fan = rays;
        narrow = atMostHalfTurn;
        rangeM = range;
        x += cos * fan.x[0] - sin * fan.y[0];
        y += sin * fan.x[0] + cos * fan.y[0];
    }

    /** Marks the rays that may meet a circle. Its centre is given relative to the camera, along the world's axes. */
    void mark(double relativeX, double relativeY, double radiusM, boolean[] wanted) {
        double reachM = rangeM + radiusM;
        if (relativeX * relativeX + relativeY * relativeY > reachM * reachM) {
            return;
        }
        double ahead = cos * relativeX + sin * relativeY; // coordinates in the robot's frame
        double left = cos * relativeY - sin * relativeX;
        int last = fan.size() - 1;
        if (narrow && (leftOf(0, ahead, left) > radiusM || leftOf(last, ahead, left) < -radiusM)) {
            return;
        }
        for (int i = 0; i <= last; i++) {
            if (Math.abs(leftOf(i, ahead, left)) <= radiusM && fan.dirX[i] * ahead + fan.dirY[i] * left >= -radiusM) {
                wanted[i] = true;
                found = true;
            }
        }
    }

    /** Distance of a point to the left of a ray's line. */
    private double leftOf(int ray, double ahead, double left) {
        return fan.dirX[ray] * left - fan.dirY[ray] * ahead;
    }
}
