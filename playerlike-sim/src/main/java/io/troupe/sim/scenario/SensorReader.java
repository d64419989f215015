package io.troupe.sim.scenario;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;

/**
 * Reads two sensors of a robot: a {@code ranger} of the classic dialect as the sonar ring, and a {@code blobfinder}.
 */
final class SensorReader {
    private static final int MOST_SONARS = 1000;
    private static final int MOST_PIXELS = 10_000;
    private static final double FARTHEST_M = 1000;
    static final double FULL_CIRCLE_RAD = 2 * Math.PI;

    private final Units units;
    private final Diagnostics diagnostics;

    SensorReader(Units units, Diagnostics diagnostics) {
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
        return names.stream()
                .map(name -> X11Colours.named(name.text(), name.where()))
                .toList();
    }

    private double fieldOfView(double written, SourcePosition where) {
        double fov = units.radians(written);
        if (fov <= 0 || fov > FULL_CIRCLE_RAD) {
            throw new WorldFileException(
                    where, "the field of view must be above 0 and at most a full circle, not " + written);
        }
        return fov;
    }
}
