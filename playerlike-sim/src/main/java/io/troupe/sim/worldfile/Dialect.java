package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import org.jspecify.annotations.Nullable;

/**
 * The Stage version for which a world is written.
 *
 * <p>It follows from what the file uses. A {@code sensor} in a ranger, {@code velocity_bounds} and
 * {@code acceleration_bounds} are Stage 4; {@code scount} of a ranger and the entity {@code laser} are classic; a world
 * with neither is classic. Unused macros do not count.
 */
enum Dialect {
    /** Stage 2 and 3: odometry starts at zero, {@code ranger_return} is 0 or 1. */
    CLASSIC,
    /** Stage 4: odometry is the global pose, {@code ranger_return} is a reflectance, negative for invisible things. */
    STAGE_4;

    /** The dialect of a world. A world that mixes both is read as Stage 4, with a warning. */
    static Dialect of(Entity world, Diagnostics diagnostics) {
        Mark newer = firstMark(world, STAGE_4);
        if (newer == null) {
            return CLASSIC;
        }
        Mark classic = firstMark(world, CLASSIC);
        if (classic != null) {
            diagnostics.warn(
                    classic.where,
                    "\"" + classic.word + "\" belongs to the classic dialect, but \"" + newer.word + "\" at "
                            + newer.where + " to that of Stage 4; the world is read as one of Stage 4");
        }
        return STAGE_4;
    }

    boolean blocksRangers(Entity model) {
        double rangerReturn = model.number("ranger_return", 1);
        return this == CLASSIC ? rangerReturn > 0 : rangerReturn >= 0;
    }

    /** Intensity of the echo of a model. */
    double reflectance(Entity model) {
        return this == CLASSIC ? (isBright(model) ? 1 : 0) : Math.max(0, model.number("ranger_return", 1));
    }

    /** True if a world of the classic dialect has something bright. */
    boolean hasBright(Entity world) {
        return this == CLASSIC && (isBright(world) || world.children().stream().anyMatch(this::hasBright));
    }

    private static boolean isBright(Entity model) {
        return model.number("laser_return", 1) >= 2;
    }

    private record Mark(String word, SourcePosition where) {}

    private static @Nullable Mark firstMark(Entity entity, Dialect dialect) {
        String type = entity.type();
        if (type.equals(dialect == STAGE_4 ? "sensor" : "laser")) {
            return new Mark(type, entity.where());
        }
        for (Property property : entity.properties().values()) {
            boolean mark = dialect == STAGE_4
                    ? type.equals("position")
                            && (property.name().equals("velocity_bounds")
                                    || property.name().equals("acceleration_bounds"))
                    : type.equals("ranger") && property.name().equals("scount");
            if (mark) {
                return new Mark(property.name(), property.where());
            }
        }
        for (Entity child : entity.children()) {
            Mark mark = firstMark(child, dialect);
            if (mark != null) {
                return mark;
            }
        }
        return null;
    }
}
