package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.DeviceSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.Traits;
import java.util.ArrayList;
import java.util.List;

/** Reads the devices of {@link io.troupe.sim.model.RobotSpec#devices}, and what they notice of a model. */
final class DeviceReader {
    private static final int MOST_BUMPERS = 1000;
    private static final double FARTHEST_M = 1000;

    private final Units units;

    DeviceReader(Units units) {
        this.units = units;
    }

    static boolean isDevice(String type) {
        return switch (type) {
            case "fiducial", "fiducialfinder", "bumper" -> true;
            default -> false;
        };
    }

    /** Reads a device of which {@link #isDevice} is true. */
    DeviceSpec read(Entity device, Pose mount) {
        return device.type().equals("bumper") ? bumpers(device, mount) : finder(device, mount);
    }

    /** What devices notice of a model. */
    static Traits traits(Entity model) {
        return new Traits(model.whole("fiducial_return", 0), model.whole("fiducial_key", 0));
    }

    private DeviceSpec finder(Entity finder, Pose mount) {
        double least = metres(finder, "range_min", 0);
        double most = metres(finder, "range_max", 8);
        if (most <= least) {
            throw new WorldFileException(
                    finder.whereOf("range_max"),
                    "\"range_max\" of a fiducial finder must be above \"range_min\", not " + most + " m and " + least
                            + " m");
        }
        double fov = finder.has("fov") ? units.radians(finder.number("fov", 0)) : StrictMath.PI;
        if (fov <= 0 || fov > 2 * Math.PI) {
            throw new WorldFileException(
                    finder.whereOf("fov"),
                    "the field of view must be above 0 and at most a full circle, not " + finder.number("fov", 0));
        }
        double[] size = finder.numbers("size", 0, 0);
        SourcePosition where = finder.whereOf("size");
        return new DeviceSpec.FiducialFinder(
                mount,
                least,
                most,
                metres(finder, "range_max_id", 5),
                fov,
                finder.whole("fiducial_key", 0),
                units.metres(size[0], where),
                units.metres(size[1], where));
    }

    private DeviceSpec bumpers(Entity row, Pose mount) {
        int count = row.whole("bcount", 0);
        if (count < 1 || count > MOST_BUMPERS) {
            throw new WorldFileException(
                    row.whereOf("bcount"), "\"bcount\" must be from 1 to " + MOST_BUMPERS + ", not " + count);
        }
        List<DeviceSpec.Bumper> parts = new ArrayList<>();
        for (int i = 0; i < count; i++) {
            String pose = Property.key("bpose", i);
            if (!row.has(pose)) {
                throw new WorldFileException(
                        row.whereOf("bcount"), "\"bcount\" is " + count + ", but " + pose + " is missing");
            }
            String length = row.has(Property.key("blength", i)) ? Property.key("blength", i) : "blength";
            double lengthM = metres(row, length, 0);
            if (lengthM == 0) {
                throw new WorldFileException(
                        row.whereOf(length), "a bumper needs a length above 0: write \"blength\" in metres");
            }
            parts.add(new DeviceSpec.Bumper(mount.compose(units.pose(row, pose)), lengthM));
        }
        long given = row.properties().values().stream()
                .filter(p -> p.name().equals("bpose"))
                .count();
        if (given > count) {
            throw new WorldFileException(
                    row.whereOf("bcount"), "\"bcount\" is " + count + ", but " + given + " bposes are given");
        }
        return new DeviceSpec.Bumpers(parts);
    }

    private double metres(Entity entity, String key, double otherwiseM) {
        double metres = entity.has(key) ? units.metres(entity.number(key, 0), entity.whereOf(key)) : otherwiseM;
        if (!(metres >= 0 && metres <= FARTHEST_M)) {
            throw new WorldFileException(
                    entity.whereOf(key),
                    "\"" + key + "\" must be from 0 to " + FARTHEST_M + " m, not " + metres);
        }
        return metres;
    }
}
