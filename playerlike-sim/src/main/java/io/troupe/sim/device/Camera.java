package io.troupe.sim.device;

import java.util.List;

/** A fan of rays from one point, placed in the world: which of them may meet a circle. */
final class Camera {
    int carrier; // number of the thing that carries it
    double rangeM;
    boolean found; // a ray was marked
    double x;
    double y;
    private double cos;
    private double sin;
    private RayFan fan = new RayFan(List.of());
    private boolean narrow; // at most a half turn from the first ray, which is the leftmost, to the last

    void place(int carrierThing, double robotX, double robotY, double robotCos, double robotSin) {
        carrier = carrierThing;
        cos = robotCos;
        sin = robotSin;
        x = robotX;
        y = robotY;
    }

    /** What the camera sees with; after it is placed. */
    void look(RayFan rays, boolean atMostHalfTurn, double range) {
        fan = rays;
        narrow = atMostHalfTurn;
        rangeM = range;
        x += cos * fan.x[0] - sin * fan.y[0];
        y += sin * fan.x[0] + cos * fan.y[0];
    }

    /** Marks the rays that may meet a circle that lies there relative to the camera, in the world's frame. */
    void mark(double relativeX, double relativeY, double radiusM, boolean[] wanted) {
        double reachM = rangeM + radiusM;
        if (relativeX * relativeX + relativeY * relativeY > reachM * reachM) {
            return;
        }
        double ahead = cos * relativeX + sin * relativeY; // in the robot's frame
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

    /** How far to the left of a ray's line a point lies. */
    private double leftOf(int ray, double ahead, double left) {
        return fan.dirX[ray] * left - fan.dirY[ray] * ahead;
    }
}
