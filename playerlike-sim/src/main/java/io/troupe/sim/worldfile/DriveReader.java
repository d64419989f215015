package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.DriveSpec;
import io.troupe.sim.model.DriveSpec.Bounds;
import io.troupe.sim.model.DriveSpec.Localization;
import io.troupe.sim.model.Pose;
import java.util.List;

/** Reads the drive and the odometry of a {@code position}. */
final class DriveReader {
    private final Units units;
    private final Dialect dialect;
    private final Diagnostics diagnostics;

    DriveReader(Units units, Dialect dialect, Diagnostics diagnostics) {
        this.units = units;
        this.dialect = dialect;
        this.diagnostics = diagnostics;
    }

    DriveSpec read(Entity position) {
        requireDifferentialDrive(position);
        double[] velocity = position.numbers("velocity", 0, 0, 0);
        SourcePosition where = position.whereOf("velocity");
        if (velocity[1] != 0) {
            diagnostics.warn(
                    where,
                    "a robot with differential drive cannot move sideways: its start speed of " + velocity[1]
                            + " that way is left out");
        }
        return new DriveSpec(
                units.metres(velocity[0], where),
                units.radians(velocity[velocity.length - 1]),
                bounds(position, "velocity_bounds"),
                bounds(position, "acceleration_bounds"),
                localization(position));
    }

    private void requireDifferentialDrive(Entity position) {
        String drive = position.text("drive", "diff");
        if (!drive.equals("diff")) {
            SourcePosition where = position.whereOf("drive");
            if (List.of("omni", "car").contains(drive)) {
                diagnostics.warn(
                        where,
                        "\"drive\" \"" + drive
                                + "\" is not simulated: the robot has two driven wheels, as with \"diff\"");
            } else {
                throw new WorldFileException(where, "\"drive\" must be \"diff\", not \"" + drive + '"');
            }
        }
    }

    /**
     * Reads {@code [x x y y z z turn turn]}, each least and greatest; y and z have no effect on a differential drive.
     */
    private Bounds bounds(Entity position, String key) {
        if (dialect == Dialect.CLASSIC) {
            return Bounds.NONE;
        }
        double[] given = position.numbers(key);
        SourcePosition where = position.whereOf(key);
        double leastForward = given.length == 0 ? -1 : units.metres(given[0], where);
        double mostForward = given.length == 0 ? 1 : units.metres(given[1], where);
        double leastTurn = given.length == 0 ? -StrictMath.PI / 2 : units.radians(given[6]);
        double mostTurn = given.length == 0 ? StrictMath.PI / 2 : units.radians(given[7]);
        if (!(leastForward <= 0 && mostForward >= 0 && leastTurn <= 0 && mostTurn >= 0)) {
            throw new WorldFileException(
                    where,
                    "\"" + key + "\" needs least <= 0 <= greatest along x and for turning, not " + leastForward + " to "
                            + mostForward + " and " + leastTurn + " to " + mostTurn + " rad");
        }
        return new Bounds(leastForward, mostForward, leastTurn, mostTurn);
    }

    private Localization localization(Entity position) {
        String kind = position.text("localization", "gps");
        return switch (kind) {
            case "gps" -> new Localization.Gps();
            case "odom" -> {
                double[] error = position.numbers("odom_error", 0.03, 0.03, 0, 0.05);
                for (double share : error) {
                    if (share < 0 || share > 2) {
                        throw new WorldFileException(
                                position.whereOf("odom_error"),
                                "\"odom_error\" must be shares from 0 to 2 of a motion, not " + share);
                    }
                }
                yield new Localization.DeadReckoning(error[0], error[1], error[error.length - 1]);
            }
            default ->
                throw new WorldFileException(
                        position.whereOf("localization"),
                        "\"localization\" must be \"gps\" or \"odom\", not \"" + kind + '"');
        };
    }

    /**
     * The odometry pose at the start. In the classic dialect it is relative to {@code localization_origin}, which
     * defaults to the start pose; in the Stage 4 dialect it is the global pose.
     */
    Pose startOdometry(Entity position, Pose start) {
        if (dialect == Dialect.STAGE_4) {
            return start;
        }
        if (!position.has("localization_origin")) {
            return Pose.ORIGIN;
        }
        Pose zero = units.pose(position, "localization_origin");
        double turnedBack = -zero.headingRad();
        return new Pose(0, 0, turnedBack)
                .compose(new Pose(start.x() - zero.x(), start.y() - zero.y(), start.headingRad()));
    }
}
