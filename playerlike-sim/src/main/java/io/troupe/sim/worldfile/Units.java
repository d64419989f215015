package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.Pose;
import java.util.Map;

/**
 * Converts a world file's lengths and angles to metres and radians.
 *
 * @param metresPerUnit of the file's unit of length
 * @param degrees true if angles are in degrees, false if in radians
 */
record Units(double metresPerUnit, boolean degrees) {
    private static final Map<String, Double> LENGTHS = Map.of("m", 1.0, "cm", 0.01, "mm", 0.001);

    /** Far beyond any world, and small enough that sums are exact to better than a micrometre. */
    private static final double FARTHEST_M = 1e6;

    static Units of(Entity world) {
        String length = world.text("unit_length", "m");
        String angle = world.text("unit_angle", "degrees");
        Double metres = LENGTHS.get(length);
        if (metres == null) {
            throw new WorldFileException(
                    world.whereOf("unit_length"),
                    "\"unit_length\" must be \"m\", \"cm\" or \"mm\", not \"" + length + '"');
        }
        if (!angle.equals("degrees") && !angle.equals("radians")) {
            throw new WorldFileException(
                    world.whereOf("unit_angle"),
                    "\"unit_angle\" must be \"degrees\" or \"radians\", not \"" + angle + '"');
        }
        return new Units(metres, angle.equals("degrees"));
    }

    double metres(double written, SourcePosition where) {
        double metres = written * metresPerUnit;
        if (!(Math.abs(metres) <= FARTHEST_M)) {
            throw new WorldFileException(where, "a length of " + metres + " m is beyond anything a world can hold");
        }
        return metres;
    }

    double radians(double written) {
        return degrees ? StrictMath.toRadians(written) : written;
    }

    /** Reads a property of the form {@code [x y z heading]} or {@code [x y heading]}. */
    Pose pose(Entity entity, String key) {
        double[] values = entity.numbers(key, 0, 0, 0);
        SourcePosition where = entity.whereOf(key);
        return new Pose(metres(values[0], where), metres(values[1], where), radians(values[values.length - 1]));
    }
}
