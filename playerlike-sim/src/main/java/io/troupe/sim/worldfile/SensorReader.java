package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeNoise;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.SonarSpec;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;

/** Reads the sensors of a robot: sonar rings and lasers of the classic dialect, rangers of Stage 4, blobfinders. */
final class SensorReader {
    private static final int MOST_SONARS = 1000;
    private static final int MOST_SAMPLES = 10_000;
    private static final int MOST_SENSORS = 1000;
    private static final int MOST_PIXELS = 10_000;
    private static final double FARTHEST_M = 1000;
    private static final double FULL_CIRCLE_RAD = 2 * Math.PI;

    private final Units units;
    private final Diagnostics diagnostics;
    private final boolean intensities;

    /** @param intensities lasers measure them from the start */
    SensorReader(Units units, Diagnostics diagnostics, boolean intensities) {
        this.intensities = intensities;
        this.units = units;
        this.diagnostics = diagnostics;
    }

    /** Reads a {@code ranger} of the classic dialect, which has an {@code scount}, mounted at {@code pose}. */
    SonarSpec sonar(Entity ranger, Pose pose) {
        int count = ranger.whole("scount", 0);
        SourcePosition where = ranger.whereOf("scount");
        if (count < 1 || count > MOST_SONARS) {
            throw new WorldFileException(where, "\"scount\" must be from 1 to " + MOST_SONARS + ", not " + count);
        }
        long given = ranger.properties().values().stream()
                .filter(p -> p.name().equals("spose"))
                .count();
        var mounts = new ArrayList<Pose>();
        for (int i = 0; i < count; i++) {
            String key = Property.key("spose", i);
            if (!ranger.has(key)) {
                throw new WorldFileException(where, "\"scount\" is " + count + ", but " + key + " is missing");
            }
            mounts.add(pose.compose(units.pose(ranger, key)));
        }
        if (given > count) {
            throw new WorldFileException(where, "\"scount\" is " + count + ", but " + given + " sposes are given");
        }
        return view(ranger, mounts);
    }

    private SonarSpec view(Entity ranger, List<Pose> mounts) {
        String key = ranger.has("sview") ? "sview" : Property.key("sview", 0);
        for (int i = 1; i < mounts.size() && !ranger.has(key); i++) {
            key = Property.key("sview", i);
        }
        if (!ranger.has(key)) {
            return new SonarSpec(mounts, 0, 5, Math.PI / mounts.size());
        }
        double[] view = ranger.numbers(key);
        SourcePosition where = ranger.whereOf(key);
        for (int i = 0; i < mounts.size(); i++) {
            String other = Property.key("sview", i);
            if (ranger.has(other) && !Arrays.equals(ranger.numbers(other), view)) {
                diagnostics.warn(
                        ranger.whereOf(other), "all sonars of a ring have one view here: that of " + where + " counts");
                break;
            }
        }
        double least = units.metres(view[0], where);
        double most = units.metres(view[1], where);
        if (least < 0 || most <= least || most > FARTHEST_M) {
            throw new WorldFileException(
                    where, "\"sview\" [min max fov] needs 0 <= min < max <= 1000 m, not " + least + " and " + most);
        }
        return new SonarSpec(mounts, least, most, fieldOfView(view[2], where));
    }

    BlobfinderSpec blobfinder(Entity blobfinder, Pose pose) {
        double[] image = blobfinder.numbers("image", 80, 60);
        for (double pixels : image) {
            if (pixels < 1 || pixels > MOST_PIXELS || pixels != StrictMath.rint(pixels)) {
                throw new WorldFileException(
                        blobfinder.whereOf("image"),
                        "\"image\" must be two whole numbers from 1 to " + MOST_PIXELS + ", not " + pixels);
            }
        }
        SourcePosition where = blobfinder.whereOf("range");
        double range = blobfinder.has("range") ? units.metres(blobfinder.number("range", 0), where) : 12;
        if (range <= 0 || range > FARTHEST_M) {
            throw new WorldFileException(where, "\"range\" must be above 0 and at most 1000 m, not " + range);
        }
        double fov = blobfinder.has("fov")
                ? fieldOfView(blobfinder.number("fov", 0), blobfinder.whereOf("fov"))
                : StrictMath.toRadians(60);
        Pose mount = pose.compose(new Pose(0, 0, units.radians(blobfinder.number("pan", 0))));
        return new BlobfinderSpec(mount, (int) image[0], (int) image[1], range, fov, colours(blobfinder));
    }

    private static List<Integer> colours(Entity blobfinder) {
        List<Value.Text> names = blobfinder.texts("colors");
        int count = blobfinder.whole("colors_count", 0);
        if (count != names.size()) {
            throw new WorldFileException(
                    blobfinder.whereOf(blobfinder.has("colors_count") ? "colors_count" : "colors"),
                    "\"colors_count\" is " + count + ", but \"colors\" has " + names.size());
        }
        return names.stream().map(Value.Text::colour).toList();
    }

    private double fieldOfView(double written, SourcePosition where) {
        double fov = units.radians(written);
        if (fov <= 0 || fov > FULL_CIRCLE_RAD) {
            throw new WorldFileException(
                    where, "the field of view must be above 0 and at most a full circle, not " + written);
        }
        return fov;
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
        return new RangerSpec(RangerSpec.Kind.LASER, mount, size[0], size[1], List.of(sensor), intensities);
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
        return new RangeNoise(units.metres(noise[0], where), noise[1], units.radians(noise[2]), RangeNoise.Law.STAGE);
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
        if (fov < 0 || fov > FULL_CIRCLE_RAD) {
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
