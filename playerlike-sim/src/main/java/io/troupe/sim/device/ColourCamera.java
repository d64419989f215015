package io.troupe.sim.device;

import io.troupe.sim.model.DeviceSpec;
import io.troupe.sim.model.Pose;
import java.util.ArrayList;
import java.util.List;

/**
 * A camera that shows what a {@link Blobfinder} sees: one ray for each image column, and every thing 0.3 m above and
 * below the camera.
 *
 * <p><b>Units and shapes.</b> Columns as in {@link Blobfinder}; rows are as tall as the vertical field of view divided
 * by their number.
 *
 * <p><b>Threads.</b> One thread at a time. <b>Cost.</b> One ray for each column; the pixels are computed only when they
 * are read.
 */
final class ColourCamera implements Device {
    private static final double HALF_HEIGHT_M = 0.3;

    private final DeviceSpec.Camera spec;
    private final RayFan fan;
    private final int[] colours;
    private final int[] halfRows; // 0 where nothing is in range

    ColourCamera(DeviceSpec.Camera spec) {
        this.spec = spec;
        List<Pose> columns = new ArrayList<>();
        for (int i = 0; i < spec.widthPx(); i++) {
            double leftRad = spec.fovRad() / 2 - (i + 0.5) * spec.fovRad() / spec.widthPx();
            columns.add(spec.mount().compose(new Pose(0, 0, leftRad)));
        }
        fan = new RayFan(columns);
        colours = new int[fan.size()];
        halfRows = new int[fan.size()];
    }

    @Override
    public void sense(Scene scene, int robot, Scratch scratch) {
        scratch.fit(fan.size());
        scene.cast(robot, fan, Ray.SIGHT, spec.rangeM(), scratch);
        double rowRad = spec.verticalFovRad() / spec.heightPx();
        for (int i = 0; i < fan.size(); i++) {
            int thing = scratch.things()[i];
            if (thing == Ray.NOTHING) {
                colours[i] = 0;
                halfRows[i] = 0;
            } else {
                colours[i] = scene.colour(thing);
                double rows = StrictMath.atan2(HALF_HEIGHT_M, scratch.distancesM()[i]) / rowRad;
                halfRows[i] = (int) Math.min(rows, spec.heightPx());
            }
        }
    }

    @Override
    public DeviceReading reading(Scene scene, int robot) {
        List<DeviceReading.Column> columns = new ArrayList<>(fan.size());
        int middle = spec.heightPx() / 2;
        for (int i = 0; i < fan.size(); i++) {
            columns.add(new DeviceReading.Column(
                    colours[i], Math.max(0, middle - halfRows[i]), Math.min(spec.heightPx(), middle + halfRows[i])));
        }
        return new DeviceReading.Picture(spec.heightPx(), columns);
    }
}
