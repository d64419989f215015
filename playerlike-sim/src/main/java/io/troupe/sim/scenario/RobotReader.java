package io.troupe.sim.scenario;

import java.util.List;
import org.jspecify.annotations.Nullable;

/** Reads a {@code position} and what hangs on it. */
final class RobotReader {
    private final Units units;
    private final SensorReader sensors;

    RobotReader(Units units) {
        this.units = units;
        this.sensors = new SensorReader(units);
    }

    RobotSpec read(Entity position, String name) {
        refuseWhatWouldChangeItsMotion(position);
        double[] size = ShapeReader.size(position, units);
        Pose pose = units.pose(position, "pose");
        Pose origin = units.pose(position, "origin");
        double mass = position.number("mass", 10);
        if (mass <= 0) {
            throw new WorldFileException(position.whereOf("mass"), "\"mass\" must be above 0 kg, not " + mass);
        }
        Entity ranger = only("ranger", position);
        Entity blobfinder = only("blobfinder", position);
        return new RobotSpec(
                name,
                pose,
                ShapeReader.shape(position, size, origin),
                Colours.of(position),
                size[0],
                size[1],
                mass,
                origin,
                startOdometry(position, pose),
                ranger == null ? null : sensors.sonar(ranger),
                blobfinder == null ? null : sensors.blobfinder(blobfinder),
                List.of(),
                position.number("ranger_return", 1) > 0,
                position.flag("blob_return", true),
                position.where());
    }

    private static void refuseWhatWouldChangeItsMotion(Entity position) {
        String drive = position.text("drive", "diff");
        if (!drive.equals("diff")) {
            throw notYet(position, "drive", drive, "diff", List.of("omni", "car"));
        }
        String localization = position.text("localization", "gps");
        if (!localization.equals("gps")) {
            throw notYet(position, "localization", localization, "gps", List.of("odom"));
        }
        for (double speed : position.numbers("velocity")) {
            if (speed != 0) {
                throw new WorldFileException(
                        position.whereOf("velocity"), "a start \"velocity\" other than zero is not supported yet");
            }
        }
        if (!position.flag("obstacle_return", true)) {
            throw new WorldFileException(
                    position.whereOf("obstacle_return"), "a robot that others can drive through is not supported yet");
        }
        WorldReader.refuseBitmap(position);
    }

    private static WorldFileException notYet(
            Entity position, String key, String value, String supported, List<String> later) {
        return new WorldFileException(
                position.whereOf(key),
                later.contains(value)
                        ? "\"" + key + "\" \"" + value + "\" is not supported yet; expected \"" + supported + '"'
                        : "\"" + key + "\" must be \"" + supported + "\", not \"" + value + '"');
    }

    /** Odometry counts from {@code localization_origin}, which is the start pose unless the file says otherwise. */
    private Pose startOdometry(Entity position, Pose start) {
        if (!position.has("localization_origin")) {
            return Pose.ORIGIN;
        }
        Pose zero = units.pose(position, "localization_origin");
        double turnedBack = -zero.headingRad();
        return new Pose(0, 0, turnedBack)
                .compose(new Pose(start.x() - zero.x(), start.y() - zero.y(), start.headingRad()));
    }

    private static @Nullable Entity only(String type, Entity position) {
        List<Entity> found = position.children().stream()
                .filter(child -> child.type().equals(type))
                .toList();
        if (found.size() > 1) {
            throw new WorldFileException(
                    found.get(1).where(),
                    "a second " + type + " on one robot is not supported yet; the first is at "
                            + found.getFirst().where());
        }
        return found.isEmpty() ? null : found.getFirst();
    }
}
