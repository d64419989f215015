package io.troupe.sim.device;

import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeNoise;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RangerSpec;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Locale;
import java.util.function.DoubleUnaryOperator;
import org.jspecify.annotations.Nullable;

/**
 * A laser or a ranger with all its sensors; each sensor is a fan of rays from right to left.
 *
 * <p><b>Units and shapes.</b> Metres; the readings of the sensors follow one another in the order of the specification.
 *
 * <p><b>Threads.</b> One thread at a time. <b>Cost.</b> A reading allocates nothing.
 */
public final class Ranger {
    private final RangerSpec spec;
    private final List<SensorRays> sensors;
    private final int size;
    private double @Nullable [] intensities; // null unless they are measured

    /**
     * Creates a ranger.
     *
     * @param draw returns for a bound a uniform random number from minus to plus that bound; called only by sensors
     *     with noise
     */
    public Ranger(RangerSpec spec, DoubleUnaryOperator draw) {
        this.spec = spec;
        if (spec.sensors().isEmpty()
                || spec.kind() == RangerSpec.Kind.LASER && spec.sensors().size() > 1) {
            throw new IllegalArgumentException("a " + spec.kind().name().toLowerCase(Locale.ROOT) + " has "
                    + spec.sensors().size() + " sensors, expected "
                    + (spec.kind() == RangerSpec.Kind.LASER ? "one" : "at least one"));
        }
        sensors = spec.sensors().stream()
                .map(sensor -> new SensorRays(sensor, draw))
                .toList();
        size = sensors.stream().mapToInt(SensorRays::size).sum();
        measureIntensities(spec.intensities());
    }

    /** Whether intensities of echoes are measured too, from the next reading on. */
    public void measureIntensities(boolean on) {
        intensities = on ? new double[size] : null;
    }

    public boolean measuresIntensities() {
        return intensities != null;
    }

    /** The intensities at the last reading, one for each range; empty if they are not measured. */
    public List<Double> intensities() {
        return intensities == null
                ? List.of()
                : Arrays.stream(intensities).boxed().toList();
    }

    /** Number of readings. */
    public int size() {
        return size;
    }

    public RangerSpec spec() {
        return spec;
    }

    /**
     * Reads all rays, ignoring the robot that carries the ranger.
     *
     * @param into receives {@link #size} ranges. A range is the distance from the sensor to what its ray hits, clamped
     *     to the sensor's minimum and maximum; the maximum if the ray hits nothing
     */
    public void read(Scene scene, int robot, Scratch scratch, double[] into) {
        int from = 0;
        for (int i = 0; i < sensors.size(); i++) {
            sensors.get(i).read(scene, robot, scratch, into, intensities, from);
            from += sensors.get(i).size();
        }
    }

    /** Reads all rays into a new list. */
    public List<Double> read(Scene scene, int robot) {
        double[] ranges = new double[size];
        read(scene, robot, new Scratch(), ranges);
        return Arrays.stream(ranges).boxed().toList();
    }

    /**
     * Directions of a sensor's rays relative to its heading, left positive, from the right end of its field of view to
     * the left end.
     */
    public static double[] directionsRad(RangeSensorSpec sensor) {
        double[] directions = new double[sensor.samples()];
        if (directions.length > 1) {
            for (int i = 0; i < directions.length; i++) {
                directions[i] = -sensor.fovRad() / 2 + i * sensor.fovRad() / (directions.length - 1);
            }
        }
        return directions;
    }

    /** One sensor. */
    private static final class SensorRays {
        /** Keeps the logarithm finite. */
        private static final double LEAST_SHARE = 1e-100;

        private final RangeSensorSpec spec;
        private final DoubleUnaryOperator draw;
        private final double[] headingsRad; // of the rays, in the robot's frame
        private final RayFan fan;
        private final double directionShare; // of the angular noise
        private final boolean noisyDirection;
        private final boolean noisyRange;

        SensorRays(RangeSensorSpec spec, DoubleUnaryOperator draw) {
            check(spec);
            this.spec = spec;
            this.draw = draw;
            headingsRad = directionsRad(spec);
            List<Pose> starts = new ArrayList<>();
            for (int i = 0; i < headingsRad.length; i++) {
                headingsRad[i] += spec.mount().headingRad();
                starts.add(new Pose(spec.mount().x(), spec.mount().y(), headingsRad[i]));
            }
            fan = new RayFan(starts);
            directionShare =
                    spec.noise().law() == RangeNoise.Law.STAGE ? spec.fovRad() / Math.max(1, spec.samples() - 1) : 1;
            noisyDirection = spec.noise().angularRad() > 0;
            noisyRange = spec.noise().constantM() > 0 || spec.noise().proportional() > 0;
        }

        private static void check(RangeSensorSpec spec) {
            if (!(spec.minRangeM() >= 0 && spec.maxRangeM() > spec.minRangeM() && spec.maxRangeM() < 1e6)) {
                throw new IllegalArgumentException("range of a ranger is [" + spec.minRangeM() + " " + spec.maxRangeM()
                        + "], expected 0 <= least < greatest, in metres");
            }
            if (spec.samples() < 1) {
                throw new IllegalArgumentException("a ranger has " + spec.samples() + " samples, expected at least 1");
            }
            if (!(spec.fovRad() >= 0 && spec.fovRad() <= 2 * StrictMath.PI)) {
                throw new IllegalArgumentException(
                        "field of view of a ranger is " + spec.fovRad() + " rad, expected 0 to a full turn");
            }
            for (double amount : new double[] {
                spec.noise().constantM(),
                spec.noise().proportional(),
                spec.noise().angularRad()
            }) {
                if (!(amount >= 0 && amount < Double.POSITIVE_INFINITY)) {
                    throw new IllegalArgumentException(
                            "noise of a ranger is " + spec.noise() + ", expected finite numbers, 0 or more");
                }
            }
        }

        int size() {
            return fan.size();
        }

        void read(Scene scene, int robot, Scratch scratch, double[] into, double @Nullable [] intensities, int from) {
            if (noisyDirection) {
                for (int i = 0; i < headingsRad.length; i++) {
                    double headingRad =
                            headingsRad[i] + draw.applyAsDouble(spec.noise().angularRad() / 2 * directionShare);
                    fan.dirX[i] = StrictMath.cos(headingRad);
                    fan.dirY[i] = StrictMath.sin(headingRad);
                }
            }
            scratch.fit(fan.size());
            double[] distancesM;
            if (intensities == null) {
                scene.castRanges(robot, fan, spec.maxRangeM(), scratch);
                distancesM = scratch.rays.distanceM;
            } else {
                scene.cast(robot, fan, Ray.RANGE, spec.maxRangeM(), scratch); // the same distances, and what is hit
                distancesM = scratch.distancesM();
                for (int i = 0; i < fan.size(); i++) {
                    int thing = scratch.things()[i];
                    intensities[from + i] = thing == Ray.NOTHING ? 0 : scene.reflectance(thing);
                }
            }
            for (int i = 0; i < fan.size(); i++) {
                double rangeM = noisyRange ? noisy(distancesM[i]) : distancesM[i];
                into[from + i] = Math.clamp(rangeM, spec.minRangeM(), spec.maxRangeM());
            }
        }

        /**
         * Adds noise to a range. Draws the same number of values for a ray that hits nothing, so that the hits of one
         * ray do not change the errors of the others.
         */
        private double noisy(double rangeM) {
            double constantM;
            double proportional;
            if (spec.noise().law() == RangeNoise.Law.STAGE) {
                constantM = StrictMath.sqrt(spec.noise().constantM()) * normal();
                proportional = draw.applyAsDouble(spec.noise().proportional());
            } else {
                constantM = draw.applyAsDouble(spec.noise().constantM() / 2);
                proportional = draw.applyAsDouble(spec.noise().proportional() / 2);
            }
            return rangeM == Double.POSITIVE_INFINITY ? rangeM : rangeM + rangeM * proportional + constantM;
        }

        /** A normal random number, by the method of Box and Muller. */
        private double normal() {
            double share = Math.max(draw.applyAsDouble(0.5) + 0.5, LEAST_SHARE);
            return StrictMath.sqrt(-2 * StrictMath.log(share)) * StrictMath.cos(draw.applyAsDouble(StrictMath.PI));
        }
    }
}
