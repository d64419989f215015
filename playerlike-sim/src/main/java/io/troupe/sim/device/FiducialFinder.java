package io.troupe.sim.device;

import io.troupe.sim.model.DeviceSpec;
import io.troupe.sim.numeric.Angles;
import java.util.ArrayList;
import java.util.List;

/**
 * Sees the markers of obstacles and other robots.
 *
 * <p>A marker is at the pose point of its thing. It is seen if it is in range and in the field of view, its key is that
 * of the finder, and nothing that rangers or blobfinders notice is before it on the line of sight, other than its own
 * thing and the robot that carries the finder.
 *
 * <p><b>Threads.</b> One thread at a time.
 *
 * <p><b>Source.</b> Stage's fiducial model.
 */
final class FiducialFinder implements Device {
    private final DeviceSpec.FiducialFinder spec;
    private List<DeviceReading.Fiducial> seen = List.of();

    FiducialFinder(DeviceSpec.FiducialFinder spec) {
        this.spec = spec;
    }

    @Override
    public void sense(Scene scene, int robot, Scratch scratch) {
        Markers markers = scene.markers();
        if (markers == null) {
            return;
        }
        double cos = scene.cos(robot);
        double sin = scene.sin(robot);
        double x = scene.x(robot) + cos * spec.mount().x() - sin * spec.mount().y();
        double y = scene.y(robot) + sin * spec.mount().x() + cos * spec.mount().y();
        double headingRad = scene.headingRad(robot) + spec.mount().headingRad();
        int[] near = scratch.markers(markers.count());
        int count = markers.within(x, spec.maxRangeM(), near);
        List<DeviceReading.Fiducial> found = new ArrayList<>();
        for (int i = 0; i < count; i++) {
            int marker = near[i];
            double dx = markers.x(marker) - x;
            double dy = markers.y(marker) - y;
            double rangeM = StrictMath.hypot(dx, dy);
            double bearingRad = Angles.wrap(StrictMath.atan2(dy, dx) - headingRad);
            if (markers.key(marker) == spec.key()
                    && rangeM < spec.maxRangeM()
                    && Math.abs(bearingRad) <= spec.fovRad() / 2
                    && scene.isInSight(robot, x, y, dx, dy, markers.thing(marker), scratch.ray)) {
                found.add(new DeviceReading.Fiducial(
                        rangeM < spec.maxIdRangeM() ? markers.id(marker) : 0,
                        rangeM * StrictMath.cos(bearingRad),
                        rangeM * StrictMath.sin(bearingRad),
                        Angles.wrap(markers.headingRad(marker) - headingRad)));
            }
        }
        seen = found;
    }

    @Override
    public DeviceReading reading(Scene scene, int robot) {
        return new DeviceReading.Fiducials(seen);
    }
}
