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
    private static final int MOST_PIXELS = 1_000_000;
    private static final double FARTHEST_M = 1000;

    private final Units units;
    private final Diagnostics diagnostics;

    DeviceReader(Units units, Diagnostics diagnostics) {
        this.units = units;
        this.diagnostics = diagnostics;
    }

    static boolean isDevice(String type) {
        return switch (type) {
            case "fiducial", "fiducialfinder", "bumper", "camera", "gripper" -> true;
            default -> false;
        };
    }

    /** Reads a device of which {@link #isDevice} is true. */
    DeviceSpec read(Entity device, Pose mount) {
        return switch (device.type()) {
            case "bumper" -> bumpers(device, mount);
            case "camera" -> camera(device, mount);
            case "gripper" -> gripper(device, mount);
            default -> finder(device, mount);
        };
    }

    /** What devices notice of a model. */
    static Traits traits(Entity model, Dialect dialect) {
        double massKg = model.number("mass", 10);
        boolean movable = model.flag("movable", false);
        if (movable && massKg <= 0) {
            throw new WorldFileException(model.whereOf("mass"), "\"mass\" must be above 0 kg, not " + massKg);
        }
        return new Traits(
                model.whole("fiducial_return", 0),
                model.whole("fiducial_key", 0),
                dialect.reflectance(model),
                model.flag("gripper_return", false),
                movable ? massKg : 0);
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

    private DeviceSpec gripper(Entity gripper, Pose mount) {
        double[] size = gripper.numbers("size", 0, 0);
        SourcePosition where = gripper.whereOf("size");
        boolean sized = gripper.has("size");
        double length = sized ? units.metres(size[0], where) : 0.2;
        double width = sized ? units.metres(size[1], where) : 0.3;
        double height = sized && size.length > 2 ? units.metres(size[2], where) : 0.2;
        if (!(length > 0 && width > 0)) {
            throw new WorldFileException(where, "\"size\" of a gripper must be above 0");
        }
        double[] paddle = gripper.numbers("paddle_size", 0.66, 0.1);
        if (!(paddle[0] > 0 && paddle[0] <= 1 && paddle[1] > 0 && paddle[1] < 0.5)) {
            throw new WorldFileException(
                    gripper.whereOf("paddle_size"),
                    "\"paddle_size\" must be shares of the gripper, above 0, at most 1 of its length and below 0.5 of its"
                            + " width, not " + paddle[0] + " and " + paddle[1]);
        }
        List<Value.Text> states = gripper.texts("paddle_state");
        String state = states.isEmpty() ? "open" : states.getFirst().text();
        if (!state.equals("open") && !state.equals("closed")) {
            throw new WorldFileException(
                    gripper.whereOf("paddle_state"),
                    "\"paddle_state\" must begin with \"open\" or \"closed\", not \"" + state + '"');
        }
        return new DeviceSpec.Gripper(
                mount,
                length,
                width,
                height,
                paddle[0],
                paddle[1],
                state.equals("closed"),
                gripper.flag("autosnatch", false));
    }

    private DeviceSpec camera(Entity camera, Pose mount) {
        double[] pixels = camera.numbers("resolution", 32, 32);
        for (double count : pixels) {
            if (count < 1 || count != StrictMath.rint(count) || pixels[0] * pixels[1] > MOST_PIXELS) {
                throw new WorldFileException(
                        camera.whereOf("resolution"),
                        "\"resolution\" must be two whole numbers from 1, with at most " + MOST_PIXELS
                                + " pixels together, not " + pixels[0] + " and " + pixels[1]);
            }
        }
        double[] range = camera.numbers("range", 0, 0);
        SourcePosition where = camera.whereOf("range");
        double most = camera.has("range") ? units.metres(range[1], where) : 8;
        if (!(most > 0 && most <= FARTHEST_M)) {
            throw new WorldFileException(
                    where,
                    "the range of a camera must end above 0 and at most at " + FARTHEST_M + " m, not at " + most);
        }
        double[] fov = camera.numbers("fov", 0, 0);
        double across = camera.has("fov") ? units.radians(fov[0]) : StrictMath.toRadians(70);
        double upright = camera.has("fov") ? units.radians(fov[1]) : StrictMath.toRadians(40);
        if (!(across > 0 && across <= 2 * Math.PI && upright > 0 && upright <= Math.PI)) {
            throw new WorldFileException(
                    camera.whereOf("fov"),
                    "\"fov\" [across upright] of a camera must be above 0, at most a full circle and half of one, not "
                            + fov[0] + " and " + fov[1]);
        }
        double[] panTilt = camera.numbers("pantilt", 0, 0);
        if (panTilt[1] != 0) {
            diagnostics.warn(
                    camera.whereOf("pantilt"), "the tilt of a camera has no effect here: it looks straight ahead");
        }
        Pose looking = mount.compose(new Pose(0, 0, units.radians(panTilt[0])));
        return new DeviceSpec.Camera(looking, (int) pixels[0], (int) pixels[1], most, across, upright);
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
                    entity.whereOf(key), "\"" + key + "\" must be from 0 to " + FARTHEST_M + " m, not " + metres);
        }
        return metres;
    }
}
