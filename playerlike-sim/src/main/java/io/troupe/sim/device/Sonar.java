package io.troupe.sim.device;

import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.SonarSpec;
import java.util.ArrayList;
import java.util.List;

/** A ring of sonars: one ray each along its heading, as Stage casts it. */
public final class Sonar {
    private Sonar() {}

    /** The readings in metres, in the order of the mounts, of a robot with that index at that pose. */
    public static List<Double> read(SonarSpec spec, Pose robot, int index, RayGrid grid) {
        var ranges = new ArrayList<Double>(spec.mounts().size());
        for (Pose mount : spec.mounts()) {
            Pose eye = robot.compose(mount);
            double range = grid.cast(eye.x(), eye.y(), eye.headingRad(), spec.maxRangeM(), index, RayGrid.FOR_RANGERS);
            ranges.add(StrictMath.max(spec.minRangeM(), range));
        }
        return ranges;
    }
}
