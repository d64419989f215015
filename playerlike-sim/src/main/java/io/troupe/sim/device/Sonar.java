package io.troupe.sim.device;

import io.troupe.sim.scenario.SonarSpec;
import java.util.Arrays;
import java.util.List;

/** A robot's ring of sonars; each casts one ray along its heading, past the robot that carries it. */
public final class Sonar {
    private final SonarSpec spec;
    private final RayFan fan;
    private final int[] things;
    private final double[] distancesM;

    public Sonar(SonarSpec spec) {
        if (!(spec.minRangeM() >= 0 && spec.maxRangeM() > spec.minRangeM() && spec.maxRangeM() < 1e6)) {
            throw new IllegalArgumentException("sonar range is [" + spec.minRangeM() + " " + spec.maxRangeM()
                    + "], expected 0 <= least < greatest, in metres");
        }
        this.spec = spec;
        fan = new RayFan(spec.mounts());
        things = new int[fan.size()];
        distancesM = new double[fan.size()];
    }

    /** One range per sonar, in metres, from the sonar to what it hits; the greatest range if it hits nothing. */
    public List<Double> read(Scene scene, int robot) {
        scene.cast(robot, fan, Ray.RANGE, spec.maxRangeM(), things, distancesM);
        return Arrays.stream(distancesM)
                .map(range -> Math.clamp(range, spec.minRangeM(), spec.maxRangeM()))
                .boxed()
                .toList();
    }
}
