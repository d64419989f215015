package io.troupe.sim.scenario;

import java.util.ArrayList;
import java.util.List;

/**
 * Reads ranging devices: the entity {@code laser} of the classic dialect, and the {@code ranger} with {@code sensor}s
 * of the Stage 4 dialect.
 */
final class RangerReader {
    private static final int MOST_SAMPLES = 10_000;
    private static final int MOST_SENSORS = 1000;
    private static final double FARTHEST_M = 1000;

    private final Units units;

    RangerReader(Units units) {
        this.units = units;
    }

    /**
     * Reads a laser. Every sample is cast, whatever the {@code resolution}: Stage casts each n-th and interpolates the
     * others.
     */
    RangerSpec laser(Entity laser, Pose mount) {
        int resolution = laser.whole("resolution", 1);
        if (resolution < 1) {
            throw new WorldFileException(
                    laser.whereOf("resolution"), "\"resolution\" must be 1 or more samples, not " + resolution);
        }
        double least = metres(laser, "range_min", 0);
        double most = metres(laser, "range_max", 8);
        checkRange(least, most, laser.whereOf(laser.has("range_max") ? "range_max" : "range_min"));
        double[] size = extent(laser, 0.15, 0.15);
        var sensor = new RangeSensorSpec(
                mount,
                least,
                most,
                fieldOfView(laser, StrictMath.PI),
                samples(laser, 180),
                size[0],
                size[1],
                RangeNoise.NONE);
        return new RangerSpec(RangerSpec.Kind.LASER, mount, size[0], size[1], List.of(sensor));
    }

    RangerSpec ranger(Entity ranger, Pose mount) {
        var sensors = new ArrayList<RangeSensorSpec>();
        for (Entity child : ranger.children()) {
            if (!child.type().equals("sensor")) {
                continue;
            }
            if (sensors.size() == MOST_SENSORS) {
                throw new WorldFileException(child.where(), "a ranger has more than " + MOST_SENSORS + " sensors");
            }
            sensors.add(sensor(child, mount));
        }
        double[] size = extent(ranger, 0.1, 0.1);
        return new RangerSpec(RangerSpec.Kind.RANGER, mount, size[0], size[1], sensors);
    }

    private RangeSensorSpec sensor(Entity sensor, Pose rangerMount) {
        double[] range = sensor.numbers("range", 0, 0);
        SourcePosition where = sensor.whereOf("range");
        double least = sensor.has("range") ? units.metres(range[0], where) : 0;
        double most = sensor.has("range") ? units.metres(range[1], where) : 5;
        checkRange(least, most, where);
        double[] size = extent(sensor, 0.02, 0.02);
        return new RangeSensorSpec(
                rangerMount.compose(units.pose(sensor, "pose")),
                least,
                most,
                fieldOfView(sensor, 0.1),
                samples(sensor, 1),
                size[0],
                size[1],
                noise(sensor));
    }

    private RangeNoise noise(Entity sensor) {
        double[] noise = sensor.numbers("noise", 0, 0, 0);
        SourcePosition where = sensor.whereOf("noise");
        for (double amount : noise) {
            if (amount < 0) {
                throw new WorldFileException(
                        where, "\"noise\" [constant proportional angular] must not be negative, not " + amount);
            }
        }
        return new RangeNoise(units.metres(noise[0], where), noise[1], units.radians(noise[2]));
    }

    private double metres(Entity entity, String key, double otherwiseM) {
        return entity.has(key) ? units.metres(entity.number(key, 0), entity.whereOf(key)) : otherwiseM;
    }

    private static void checkRange(double least, double most, SourcePosition where) {
        if (least < 0 || most <= least || most > FARTHEST_M) {
            throw new WorldFileException(
                    where, "the range needs 0 <= least < greatest <= 1000 m, not " + least + " to " + most);
        }
    }

    private double fieldOfView(Entity entity, double otherwiseRad) {
        if (!entity.has("fov")) {
            return otherwiseRad;
        }
        double written = entity.number("fov", 0);
        double fov = units.radians(written);
        if (fov < 0 || fov > SensorReader.FULL_CIRCLE_RAD) {
            throw new WorldFileException(
                    entity.whereOf("fov"), "\"fov\" must be from 0 to a full circle, not " + written);
        }
        return fov;
    }

    private static int samples(Entity entity, int otherwise) {
        int samples = entity.whole("samples", otherwise);
        if (samples < 1 || samples > MOST_SAMPLES) {
            throw new WorldFileException(
                    entity.whereOf("samples"), "\"samples\" must be from 1 to " + MOST_SAMPLES + ", not " + samples);
        }
        return samples;
    }

    /** The size of a device; unlike that of a body it may be 0. */
    private double[] extent(Entity entity, double lengthM, double widthM) {
        if (!entity.has("size")) {
            return new double[] {lengthM, widthM};
        }
        double[] size = entity.numbers("size");
        SourcePosition where = entity.whereOf("size");
        double[] metres = {units.metres(size[0], where), units.metres(size[1], where)};
        if (metres[0] < 0 || metres[1] < 0) {
            throw new WorldFileException(where, "\"size\" of a " + entity.type() + " must not be negative");
        }
        return metres;
    }
}
