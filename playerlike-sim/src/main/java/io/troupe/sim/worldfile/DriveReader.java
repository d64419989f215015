package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.DriveSpec;
import io.troupe.sim.model.DriveSpec.Bounds;
import io.troupe.sim.model.DriveSpec.Localization;
import io.troupe.sim.model.DriveSpec.Steering;
import io.troupe.sim.model.Pose;

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
        Steering steering = steering(position);
        boolean sideways = steering instanceof Steering.Omnidirectional;
        double[] velocity = position.numbers("velocity", 0, 0, 0);
        SourcePosition where = position.whereOf("velocity");
        if (velocity[1] != 0 && !sideways) {
            diagnostics.warn(
                    where,
                    "only a robot whose drive is \"omni\" can move sideways: its start speed of " + velocity[1]
                            + " that way is left out");
        }
        return new DriveSpec(
                units.metres(velocity[0], where),
                units.radians(velocity[velocity.length - 1]),
                bounds(position, "velocity_bounds", sideways),
                bounds(position, "acceleration_bounds", sideways),
                localization(position),
                steering,
                sideways ? units.metres(velocity[1], where) : 0);
    }

    private Steering steering(Entity position) {
        String drive = position.text("drive", "diff");
        return switch (drive) {
            case "diff" -> new Steering.Differential();
            case "omni" -> new Steering.Omnidirectional();
            case "car" -> {
                double wheelbase = position.has("wheelbase")
                        ? units.metres(position.number("wheelbase", 1), position.whereOf("wheelbase"))
                        : 1;
                if (wheelbase <= 0) {
                    throw new WorldFileException(
                            position.whereOf("wheelbase"), "\"wheelbase\" must be above 0 m, not " + wheelbase);
                }
                yield new Steering.Car(wheelbase);
            }
            default ->
                throw new WorldFileException(
                        position.whereOf("drive"),
                        "\"drive\" must be \"diff\", \"omni\" or \"car\", not \"" + drive + '"');
        };
    }

    /**
     * Reads {@code [x x y y z z turn turn]}, each least and greatest; z has no effect, and y only on an omnidirectional
     * drive.
     */
    private Bounds bounds(Entity position, String key, boolean sideways) {
        if (dialect == Dialect.CLASSIC) {
            return Bounds.NONE;
        }
        double[] given = position.numbers(key);
        SourcePosition where = position.whereOf(key);
        double leastForward = given.length == 0 ? -1 : units.metres(given[0], where);
        double mostForward = given.length == 0 ? 1 : units.metres(given[1], where);
        double leastSideways = given.length == 0 ? -1 : units.metres(given[2], where);
        double mostSideways = given.length == 0 ? 1 : units.metres(given[3], where);
        double leastTurn = given.length == 0 ? -StrictMath.PI / 2 : units.radians(given[6]);
        double mostTurn = given.length == 0 ? StrictMath.PI / 2 : units.radians(given[7]);
        if (!(leastForward <= 0 && mostForward >= 0 && leastTurn <= 0 && mostTurn >= 0)) {
            throw new WorldFileException(
                    where,
                    "\"" + key + "\" needs least <= 0 <= greatest along x and for turning, not " + leastForward + " to "
                            + mostForward + " and " + leastTurn + " to " + mostTurn + " rad");
        }
        if (!sideways) {
            return new Bounds(leastForward, mostForward, leastTurn, mostTurn);
        }
        if (!(leastSideways <= 0 && mostSideways >= 0)) {
            throw new WorldFileException(
                    where,
                    "\"" + key + "\" needs least <= 0 <= greatest along y, not " + leastSideways + " to "
                            + mostSideways);
        }
        return new Bounds(leastForward, mostForward, leastSideways, mostSideways, leastTurn, mostTurn);
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
