package io.troupe.sim.device;

import io.troupe.sim.model.Pose;
import java.util.List;

/** Rays with fixed start poses in the robot's frame. */
final class RayFan {
    final double[] x;
    final double[] y;
    final double[] dirX;
    final double[] dirY;

    RayFan(List<Pose> starts) {
        x = starts.stream().mapToDouble(Pose::x).toArray();
        y = starts.stream().mapToDouble(Pose::y).toArray();
        dirX = starts.stream()
                .mapToDouble(start -> StrictMath.cos(start.headingRad()))
                .toArray();
        dirY = starts.stream()
                .mapToDouble(start -> StrictMath.sin(start.headingRad()))
                .toArray();
    }

    int size() {
        return x.length;
    }
}
