package io.troupe.sim.device;

import io.troupe.sim.model.SonarSpec;
import java.util.List;

/** A robot's ring of sonars. Each sonar casts one ray along its heading, ignoring the robot that carries it. */
public final class Sonar {
    private final SonarSpec spec;
    private final RayFan fan;
    private final List<FanTable> tables; // none for a fan of many rays
    private final double[] rangesM;

    public Sonar(SonarSpec spec) {
        this(check(spec), new RayFan(spec.mounts()));
    }

    private Sonar(SonarSpec spec, RayFan fan) {
        this(spec, fan, FanTable.of(fan, spec.maxRangeM()));
    }

    private Sonar(SonarSpec spec, RayFan fan, List<FanTable> tables) {
        this.spec = spec;
        this.fan = fan;
        this.tables = tables;
        rangesM = new double[fan.size()];
    }

    private static SonarSpec check(SonarSpec spec) {
        if (!(spec.minRangeM() >= 0 && spec.maxRangeM() > spec.minRangeM() && spec.maxRangeM() < 1e6)) {
            throw new IllegalArgumentException("sonar range is [" + spec.minRangeM() + " " + spec.maxRangeM()
                    + "], expected 0 <= least < greatest, in metres");
        }
        return spec;
    }

    /** Creates another ring of this specification, with separate readings; the immutable tables are shared. */
    public Sonar twin() {
        return new Sonar(spec, fan, tables);
    }

    /** Reads all sonars; allocates nothing. */
    public void sense(Scene scene, int robot, Scratch scratch) {
        scratch.fit(fan.size());
        if (tables.isEmpty()) {
            scene.castRanges(robot, fan, spec.maxRangeM(), scratch);
        } else {
            scene.projectRanges(robot, tables, spec.maxRangeM(), scratch);
        }
        double[] distancesM = scratch.rays.distanceM;
        for (int i = 0; i < rangesM.length; i++) {
            rangesM[i] = Math.clamp(distancesM[i], spec.minRangeM(), spec.maxRangeM());
        }
    }

    public int count() {
        return rangesM.length;
    }

    /** Range of a sonar at the last reading, in metres; the maximum range if it hit nothing. */
    public double rangeM(int sonar) {
        return rangesM[sonar];
    }

    /** The last ranges, one per sonar. */
    public List<Double> rangesM() {
        var boxed = new Double[rangesM.length];
        for (int i = 0; i < boxed.length; i++) {
            boxed[i] = rangesM[i];
        }
        return List.of(boxed);
    }

    /** Reads all sonars and returns their ranges. */
    public List<Double> read(Scene scene, int robot) {
        sense(scene, robot, new Scratch());
        return rangesM();
    }
}
